// Reading text: numbers, the words of a language, and the search for a word.

#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "studies/gate/layouts/kernels/work.h"

namespace kernels {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Reads one number, like "-12.5e3", and moves behind it.
double read_number(const char*& at) {
  const bool negative = *at == '-';
  if (negative) ++at;
  double value = 0;
  int exponent = 0;
  for (; is_digit(*at); ++at) value = 10 * value + (*at - '0');
  if (*at == '.')
    for (++at; is_digit(*at); ++at, --exponent) value = 10 * value + (*at - '0');
  if (*at == 'e') {
    const bool is_small = *++at == '-';
    if (is_small) ++at;
    int shown = 0;
    for (; is_digit(*at); ++at) shown = 10 * shown + (*at - '0');
    exponent += is_small ? -shown : shown;
  }
  for (; exponent > 0; --exponent) value *= 10;
  for (; exponent < 0; ++exponent) value /= 10;
  return negative ? -value : value;
}

[[gnu::noinline]] double sum_lines(const std::vector<std::string>& lines) {
  double sum = 0;
  for (const std::string& line : lines)
    for (const char* at = line.c_str(); *at; ++at) sum += read_number(at);
  return sum;
}

std::string digits(Random& random, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += static_cast<char>('0' + random.below(10));
  return text;
}

void numbers(benchmark::State& state) {
  Random random(5);
  std::vector<std::string> lines(10);
  for (std::string& line : lines)  // each number ends with a space
    for (int n = 0; n < 8; ++n) {
      if (random.below(2)) line += '-';
      line += digits(random, 1 + (n * 3 + 1) % 4);
      if (n % 4 != 0) line += '.' + digits(random, 1 + n % 5);
      if (n == 6) line += "e-3";
      line += ' ';
    }
  const int passes = passes_of("numbers");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(sum_lines(lines));
}
BENCHMARK(numbers);

struct Counts {
  int names = 0, numbers = 0, strings = 0, comments = 0, signs = 0;
};

/// Splits a line into words, character by character.
void tokenize(std::string_view line, Counts& counts) {
  enum class In { space, name, number, string, escape, slash, comment };
  In in = In::space;
  for (const char c : line) {
    switch (in) {
      case In::string:
        if (c == '\\') in = In::escape;
        if (c == '"') in = In::space;
        continue;
      case In::escape:
        in = In::string;
        continue;
      case In::comment:
        continue;
      case In::slash:
        if (c == '/') {
          in = In::comment;
          ++counts.comments;
          continue;
        }
        ++counts.signs;
        break;
      case In::name:
        if (is_letter(c) || is_digit(c)) continue;
        break;
      case In::number:
        if (is_digit(c) || c == '.') continue;
        break;
      case In::space:
        break;
    }
    in = In::space;
    if (is_letter(c)) {
      in = In::name;
      ++counts.names;
    } else if (is_digit(c)) {
      in = In::number;
      ++counts.numbers;
    } else if (c == '"') {
      in = In::string;
      ++counts.strings;
    } else if (c == '/') {
      in = In::slash;
    } else if (c != ' ') {
      ++counts.signs;
    }
  }
}

[[gnu::noinline]] Counts tokenize_lines(const std::vector<std::string>& lines) {
  Counts counts;
  for (const std::string& line : lines) tokenize(line, counts);
  return counts;
}

void tokenizer(benchmark::State& state) {
  // In a line, a is a random letter and 0 a random digit.
  constexpr std::array<std::string_view, 20> forms = {"aaaaa aaa = aaaaaa(aaa, 00);",
                                                      "if (aaa < 0.00) aaaaaa aaaaa;",
                                                      "aa_aaa += aaa[aa] * 0;",
                                                      "// aaaa aaa aa aaaaaa",
                                                      "aaaaaa aaaaaa aaaa{0, 00, 000};",
                                                      "  aaaaa(\"aaa \\\" aaaa\", aaa);",
                                                      "}",
                                                      "aaa aaa = (aa + aa) / 0;",
                                                      "aaaaaa aaaa(aaa a, aaa aa) {",
                                                      "  aaaaa.aaaa(aaaaaa(aaa, aaa));",
                                                      "aaaa (aaaa& aaaaa : aaaaaa) ++aaaa;",
                                                      "",
                                                      "aaaaaa aaa a0 = a0 - 0.000 * a00;",
                                                      "\"aaaaa aaa\" \"a\" \"\\\\\" aaaa",
                                                      "aaaaaa \"aaaaaaa aaaa\"; // aaa",
                                                      "{ { } }",
                                                      "aaaaaaaaaaaaaa::aaaaaaaaa<aaa>()",
                                                      "0 00 000 0.0 00.00, 0000",
                                                      "  aaaaaa !aa && (aa || aaa);",
                                                      "aaaa/aaa/aa // /"};
  Random random(6);
  std::vector<std::string> lines(2 * forms.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i] = forms[i % forms.size()];
    for (char& c : lines[i]) {
      if (c == 'a') c = static_cast<char>('a' + random.below(26));
      if (c == '0') c = static_cast<char>('0' + random.below(10));
    }
  }
  const int passes = passes_of("tokenizer");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(tokenize_lines(lines));
}
BENCHMARK(tokenizer);

/// How often a word is in a text, by Horspool's algorithm.
int count_in(std::string_view text, std::string_view word, const std::array<unsigned char, 256>& skip) {
  int found = 0;
  for (std::size_t end = word.size(); end <= text.size();) {
    std::size_t same = 0;
    while (same < word.size() && text[end - 1 - same] == word[word.size() - 1 - same]) ++same;
    if (same == word.size()) ++found;
    end += skip[static_cast<unsigned char>(text[end - 1])];
  }
  return found;
}

[[gnu::noinline]] int search_all(const std::vector<std::string>& texts, std::string_view word) {
  std::array<unsigned char, 256> skip;
  skip.fill(static_cast<unsigned char>(word.size()));
  for (std::size_t i = 0; i + 1 < word.size(); ++i)
    skip[static_cast<unsigned char>(word[i])] = static_cast<unsigned char>(word.size() - 1 - i);
  int found = 0;
  for (const std::string& text : texts) found += count_in(text, word, skip);
  return found;
}

void search(benchmark::State& state) {
  constexpr std::string_view letters = "eeeetttaaaooiinnsshhrrdlu   ";
  Random random(7);
  std::vector<std::string> texts(20);
  for (std::string& text : texts) {
    text.resize(256);
    for (char& c : text) c = letters[static_cast<std::size_t>(random.below(static_cast<int>(letters.size())))];
    text.replace(static_cast<std::size_t>(random.below(240)), 5, "third");
  }
  const int passes = passes_of("search");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(search_all(texts, "third"));
}
BENCHMARK(search);

}  // namespace
}  // namespace kernels
