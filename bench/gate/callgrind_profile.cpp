#include "bench/gate/callgrind_profile.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/base/errors.h"

namespace ccdt::gate {
namespace {

[[noreturn]] void fail(const std::string& what, long long line) {
  throw InputError("this is not a profile of callgrind: " + what, {.line = line},
                   "make one with valgrind --tool=callgrind, without --dump-instr, --cache-sim and --branch-sim");
}

std::optional<std::uint64_t> number_of(std::string_view word) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

/// Callgrind writes a name once, "(12) name", and later only "(12)".
class Names {
 public:
  /// None if the name was not written before.
  const std::string* of(std::string_view text) {
    const auto close = text.find(')');
    if (!text.starts_with('(') || close == std::string_view::npos) return remember(text, text);
    const auto id = text.substr(0, close + 1);
    if (text.size() > close + 2) return remember(id, text.substr(close + 2));
    const auto found = names_.find(std::string(id));
    return found == names_.end() ? nullptr : &found->second;
  }

 private:
  const std::string* remember(std::string_view id, std::string_view name) {
    // "'2" marks a call within a call of the same function, " [clone .avx2]" one of several versions of it.
    name = name.substr(0, name.find(" [clone "));
    const auto mark = name.rfind('\'');
    if (mark != std::string_view::npos && number_of(name.substr(mark + 1))) name = name.substr(0, mark);
    return &names_.insert_or_assign(std::string(id), std::string(name)).first->second;
  }

  std::unordered_map<std::string, std::string> names_;
};

/// The words of a line, separated by spaces.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const auto end = std::min(line.find(' '), line.size());
    if (end > 0) words.push_back(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return words;
}

/// Reads the lines of a profile that describe costs and calls.
class Reader {
 public:
  CallGraph read(std::string_view profile) {
    while (!profile.empty()) {
      const auto end = std::min(profile.find('\n'), profile.size() - 1);
      ++line_;
      take(profile.substr(0, profile[end] == '\n' ? end : end + 1));
      profile.remove_prefix(end + 1);
    }
    if (events_.empty() || events_.front() != "Ir" || !is_by_line_)
      fail("it does not count instructions by line", line_);
    return std::move(graph_);
  }

 private:
  void take(std::string_view line) {
    if (after_calls_) {
      add_call(line);
    } else if (line.starts_with("fn=")) {
      caller_ = name_of(line.substr(3));
      own_ = &graph_.own[caller_];
    } else if (line.starts_with("cfn=")) {
      callee_ = name_of(line.substr(4));
    } else if (line.starts_with("calls=")) {
      after_calls_ = true;
      const auto words = words_of(line.substr(6));
      count_ = words.empty() ? 0 : number_of(words.front()).value_or(0);
    } else if (line.starts_with("events:")) {
      for (const std::string_view word : words_of(line.substr(7))) events_.emplace_back(word);
    } else if (line.starts_with("positions:")) {
      is_by_line_ = line == "positions: line";
    } else if (own_ != nullptr && is_position(line)) {
      *own_ += cost_in(line, 0);
      const auto system = std::ranges::find(events_, "sysCount");
      if (system != events_.end()) graph_.system_calls += cost_in(line, system - events_.begin());
    }
  }

  /// "12", "+3", "-3" or "*": the line of the source, relative to the line before.
  static bool is_position(std::string_view line) {
    return !line.empty() && std::string_view("+-*0123456789").find(line.front()) != std::string_view::npos;
  }

  /// The cost of an event in a line of costs. Zeros at the end are left out.
  static std::uint64_t cost_in(std::string_view line, std::ptrdiff_t event) {
    const auto words = words_of(line);
    const auto at = static_cast<std::size_t>(event) + 1;
    return at < words.size() ? number_of(words[at]).value_or(0) : 0;
  }

  std::string name_of(std::string_view text) {
    const std::string* name = names_.of(text);
    if (name == nullptr) fail("it uses a name that it has not defined", line_);
    return *name;
  }

  /// The line after "calls=" has the place and the cost of the call.
  void add_call(std::string_view line) {
    after_calls_ = false;
    const auto words = words_of(line);
    const auto cost = is_position(line) ? number_of(words.size() > 1 ? words[1] : "0") : std::nullopt;
    if (!cost) fail("a call has no cost", line_);
    if (const auto [begin, end] = graph_.calls.equal_range(caller_); begin != end) {
      const auto known = std::find_if(begin, end, [&](const auto& call) { return call.second.name == callee_; });
      if (known != end) {
        known->second.instructions += *cost;
        known->second.calls += count_;
        return;
      }
    }
    graph_.calls.emplace(caller_, CallGraph::Callee{callee_, *cost, count_});
  }

  CallGraph graph_;
  Names names_;
  std::string caller_, callee_;
  std::uint64_t* own_ = nullptr;  ///< instructions of the caller
  std::uint64_t count_ = 0;       ///< of calls
  std::vector<std::string> events_;
  long long line_ = 0;
  bool after_calls_ = false, is_by_line_ = false;
};

}  // namespace

CallGraph read_callgrind(std::string_view profile) {
  return Reader().read(profile);
}

std::string_view bare_name(std::string_view function) {
  const auto open = function.find('(');
  if (open == std::string_view::npos) return function;
  int depth = 0;
  for (std::size_t i = open; i < function.size(); ++i) {
    if (function[i] == '(') ++depth;
    if (function[i] == ')') --depth;
    if (depth == 0) return i + 1 == function.size() ? function.substr(0, open) : function;
  }
  return function;
}

std::uint64_t inclusive_instructions(const CallGraph& graph, std::string_view function) {
  std::uint64_t sum = 0;
  for (const auto& [caller, callee] : graph.calls)
    if (bare_name(callee.name) == function && bare_name(caller) != function) sum += callee.instructions;
  return sum;
}

}  // namespace ccdt::gate
