#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/tests/experiment_json.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Texts = nlohmann::ordered_json;

/// Texts of files that would act if an output did not escape them.
const std::vector<std::string>& hostile_texts() {
  static const std::vector<std::string> texts = {
      "</script><script>document.title='owned'</script><!--",
      "<img src=x onerror=document.title='owned'>",
      "[a link](javascript:document.title='owned') ![](x)",
      "`code` ``more`` `",
      "a|b|c",
      "two\n\n# lines\n| of | cells |",
      "\r\n---\r\n",
      "# heading",
      "=HYPERLINK(\"x\")",
      "+1+1",
      "-1+1",
      "@SUM(1)",
      "\t=1",
      "a,\"b\"\r\nc",
      "\\input{/etc/passwd} $x$ & % # _ ^ ~ {",
      "[4pt]",
      "*",
      "\x1B]0;title\x07\x1B[31m",
      "\xC2\x9B"
      "31m",
      "\xE2\x80\xAE"
      "turned",
      "&lt;b&gt; &amp;",
  };
  return texts;
}

/// Nothing from a file acts on what shows it: each output has its own rule, and the texts are still there.
class HostileTexts : public Program {
 protected:
  HostileTexts() {
    EXPECT_EQ(run("model cube --edge-length 1 -o cube.off").exit_code, 0);
    EXPECT_EQ(run("mesh cube.off -o cube.vtu --report run.json").exit_code, 0);
  }

  /// Makes the report of an experiment whose texts are all hostile.
  Outcome report_of_hostile_experiment() const {
    std::filesystem::create_directory(work() / "D");
    Texts columns = Texts::array({{{"name", "text"}, {"title", "<b>"}, {"kind", "label"}, {"unit", "|`"}}});
    columns.push_back({{"name", "=x"}, {"title", "x"}, {"kind", "note"}, {"unit", ""}});
    Texts rows = Texts::array();
    for (const std::string& text : hostile_texts())
      rows.push_back({{"values", {{"text", text}, {"=x", text}}}, {"runs", Texts::array()}});
    const Texts table = {{"name", "texts"},
                         {"title", hostile_texts()[14] + "\n\n" + hostile_texts()[0]},
                         {"data", false},
                         {"columns", columns},
                         {"rows", rows}};
    Json experiment = empty_experiment(Json::parse(text_of(work() / "run.json"))["environment"]);
    experiment.update({{"title", hostile_texts()[1] + "\n# " + hostile_texts()[2]},
                       {"section", hostile_texts()[0]},
                       {"command", hostile_texts()[5]},
                       {"definitions", hostile_texts()},
                       {"findings", hostile_texts()},
                       {"problems", hostile_texts()},
                       {"tables", Json::array({Json::parse(table.dump())})}});
    write("D/fig7.json", experiment.dump());
    const Outcome outcome = run("report D");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  }

  /// Markdown shows no markup: HTML and links are not opened, and lines begin only with what the program itself writes.
  static void expect_plain_markdown(const std::string& text, std::size_t cells) {
    std::string outside_code;  // what GitHub would interpret
    bool is_code = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (!is_code && text[i] == '\\') {
        ++i;
        continue;
      }
      std::size_t ticks = 0;
      while (i + ticks < text.size() && text[i + ticks] == '`') ++ticks;
      if (ticks > 0) {
        const std::string fence(ticks, '`');
        std::size_t end = i + ticks;  // of a fence that is exactly as long
        while ((end = text.find(fence, end)) != std::string::npos && (text[end - 1] == '`' || text[end + ticks] == '`'))
          ++end;
        ASSERT_NE(end, std::string::npos) << "code that does not end: " << text.substr(i, 80);
        const std::string code = text.substr(i, end - i);
        EXPECT_EQ(code.find('\n'), std::string::npos) << code;
        i = end + ticks - 1;
        continue;
      }
      outside_code += text[i];
    }
    for (const char* markup : {"<script", "<img", "<b>", "<!--", "](", "\n# lines", "\n---", "\r"})
      EXPECT_EQ(outside_code.find(markup), std::string::npos) << markup << "\n" << outside_code;
    std::istringstream lines(outside_code);
    for (std::string line; std::getline(lines, line);) {
      const bool is_row = line.starts_with("| ");
      const auto bars = static_cast<std::size_t>(std::ranges::count(line, '|'));
      EXPECT_TRUE(!is_row || cells == 0 || bars == cells + 1) << line;
    }
  }

  /// The cells of CSV, by RFC 4180.
  static std::vector<std::vector<std::string>> cells_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows(1, {""});
    bool is_quoted = false;
    for (std::size_t i = 0; i < csv.size(); ++i) {
      const char c = csv[i];
      if (is_quoted && c == '"' && i + 1 < csv.size() && csv[i + 1] == '"')
        rows.back().back() += csv[++i];
      else if (c == '"')
        is_quoted = !is_quoted;
      else if (!is_quoted && c == ',')
        rows.back().emplace_back();
      else if (!is_quoted && csv.compare(i, 2, "\r\n") == 0)
        ++i, rows.push_back({""});
      else
        rows.back().back() += c;
    }
    rows.pop_back();
    return rows;
  }

  static void expect_no_formula(const std::string& csv) {
    const auto rows = cells_of(csv);
    for (const auto& row : rows) {
      EXPECT_EQ(row.size(), rows.front().size());
      for (const std::string& cell : row)
        EXPECT_TRUE(cell.empty() || std::string_view("=+-@\t\r\n").find(cell[0]) == std::string_view::npos) << cell;
    }
  }
};

TEST_F(HostileTexts, OnATerminalAreEscaped) {
  const Outcome outcome = report_of_hostile_experiment();
  write("bad.stl", "solid \x1B[31m\n" + hostile_texts()[17]);
  const std::string name = "a\x1B[31m\xE2\x80\xAE\x9B.off";
  std::filesystem::copy_file(work() / "cube.off", work() / name);
  std::string said = outcome.out + outcome.err;
  for (const std::string arguments : {"check bad.stl", "check '%'", "mesh '%' -o '%.vtu'", "verify '%' cube.vtu",
                                      "report '%'", "gate '%' --against '%'", "mesh cube.off -o o.vtu --mesher '%'",
                                      "sweep '%' -o new", "reproduce '%' -o new", "model '%' -o o.off"}) {
    std::string call = arguments;
    for (std::size_t at = call.find('%'); at != std::string::npos; at = call.find('%')) call.replace(at, 1, name);
    const Outcome one = run(call);
    said += one.out + one.err;
  }
  for (const char* control : {"\x1B", "\x07", "\x9B", "\xE2\x80\xAE"})
    EXPECT_EQ(said.find(control), std::string::npos) << said;
}

TEST_F(HostileTexts, OnThePageAreShownByABrowser) {
  const char* chosen = std::getenv("CCDT_CHROMIUM");
  const std::string browser = chosen == nullptr ? "/usr/bin/chromium" : chosen;
  report_of_hostile_experiment();
  if (!std::filesystem::exists(work() / "D/index.html")) GTEST_SKIP() << "this build has no page";
  if (!std::filesystem::exists(browser)) GTEST_SKIP() << "there is no " << browser;
  const std::string call = "HOME='" + work().string() + "' '" + browser +
                           "' --headless --no-sandbox --disable-gpu --virtual-time-budget=20000 --dump-dom 'file://" +
                           (work() / "D/index.html").string() + "' 2>/dev/null >'" + (work() / "dom").string() + "'";
  ASSERT_EQ(std::system(call.c_str()), 0);
  const std::string dom = text_of(work() / "dom");
  EXPECT_NE(dom.find("&lt;img src=x onerror"), std::string::npos) << "shown as text";
  EXPECT_EQ(dom.find("<title>owned"), std::string::npos);
  EXPECT_EQ(dom.find("href=\"javascript:"), std::string::npos);
  EXPECT_EQ(dom.find("<img src=\"x\""), std::string::npos);
}

TEST_F(HostileTexts, InMarkdownOfAReportAreShown) {
  report_of_hostile_experiment();
  expect_plain_markdown(text_of(work() / "D/fig7.md"), 2);
  expect_plain_markdown(text_of(work() / "D/tables/fig7-texts.md"), 2);
}

TEST_F(HostileTexts, InMarkdownOfAGateAreShown) {
  Texts base = {{"context", Texts::object()}, {"benchmarks", Texts::array()}}, head = base;
  for (const std::string& text : hostile_texts())
    for (Texts* side : {&base, &head})
      (*side)["benchmarks"].push_back({{"name", text},
                                       {"run_type", "iteration"},
                                       {"iterations", 1},
                                       {"real_time", 1.0},
                                       {"cpu_time", 1.0},
                                       {"time_unit", "ns"},
                                       {"n|`" + text, side == &base ? 1 : 2}});
  head["benchmarks"].erase(0);
  write("base.json", base.dump());
  write("head.json", head.dump());
  const Outcome outcome = run("gate head.json --against base.json --markdown verdict.md");
  EXPECT_NE(outcome.exit_code, 0);
  const std::string text = text_of(work() / "verdict.md");
  EXPECT_NE(text.find("HYPERLINK"), std::string::npos);
  expect_plain_markdown(text, 0);
  EXPECT_EQ((outcome.out + outcome.err).find('\x1B'), std::string::npos);
}

TEST_F(HostileTexts, InLatexAreNoCommands) {
  report_of_hostile_experiment();
  const std::string text = text_of(work() / "D/tables/fig7-texts.tex");
  EXPECT_NE(text.find("\\textbackslash{}input\\{/etc/passwd\\} \\$x\\$ \\& \\% \\# \\_ \\^{} \\~{} \\{"),
            std::string::npos);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    ASSERT_NE(first, std::string::npos) << "an empty line is a paragraph, which a caption must not have";
    EXPECT_TRUE(line[first] != '[' && line[first] != '*') << "this is an argument of the row before: " << line;
    for (std::size_t i = 0; i < line.size(); ++i) EXPECT_GE(static_cast<unsigned char>(line[i]), 32) << line;
    if (line.find("\\\\") == std::string::npos) continue;  // no row of the table
    EXPECT_EQ(line.find(" & "), line.rfind(" & ")) << "two cells: " << line;
  }
}

TEST_F(HostileTexts, InTablesForSpreadsheetsAreNoFormulas) {
  report_of_hostile_experiment();
  const std::string csv = text_of(work() / "D/tables/fig7-texts.csv");
  expect_no_formula(csv);
  EXPECT_EQ(cells_of(csv).size(), hostile_texts().size() + 1);
  EXPECT_EQ(cells_of(csv)[14][0], hostile_texts()[13]) << "other texts are unchanged";
}

TEST_F(HostileTexts, InTheRunsOfASweepAreNoFormulas) {
  std::filesystem::copy_file(work() / "cube.off", work() / "=cube, \"x\".off");
  write("spec.json", R"({"schema": "ccdt.sweep/1", "name": "=1+1", "inputs": [{"files": "=cube*.off"}],
                         "meshers": ["ccdt"], "repetitions": 1, "options": {"lattice": ["none"]}})");
  ASSERT_EQ(run("sweep spec.json -o S").exit_code, 0);
  for (const auto& entry : std::filesystem::directory_iterator(work() / "S/runs")) {
    Texts record = Texts::parse(text_of(entry.path()));
    record["environment"]["cpu"] = "@SUM(1)";
    write(entry.path().lexically_relative(work()), record.dump());
  }
  ASSERT_EQ(run("report S").exit_code, 0);
  const std::string csv = text_of(work() / "S/runs.csv");
  EXPECT_NE(csv.find("SUM(1)"), std::string::npos);
  expect_no_formula(csv);
}

TEST_F(HostileTexts, InJsonAreTheSame) {
  report_of_hostile_experiment();
  const Texts report = Texts::parse(text_of(work() / "D/report.json"));
  const auto found = std::ranges::find_if(report["experiments"], [](const Texts& e) { return e["name"] == "fig7"; });
  ASSERT_NE(found, report["experiments"].end());
  EXPECT_EQ((*found)["findings"], Texts(hostile_texts()));
}

TEST_F(HostileTexts, OfSurfacesAreNotInMeshes) {
  write("plain.off", text_of(work() / "cube.off"));
  ASSERT_EQ(run("check plain.off --repair -o plain.obj").exit_code, 0);
  write("named.obj", "o </VTKFile>&\ng $Strange\nusemtl ]]>\n" + text_of(work() / "plain.obj"));
  for (const char* ending : {".vtu", ".msh", ".mesh", ".node", ".inp", ".xdmf", ".polymesh"}) {
    ASSERT_EQ(run("mesh named.obj -o named" + std::string(ending)).exit_code, 0);
    const std::filesystem::path file = work() / ("named" + std::string(ending));
    const std::string text = text_of(std::filesystem::is_directory(file) ? file / "boundary" : file);
    for (const char* name : {"</VTKFile>&", "$Strange", "]]>"}) EXPECT_EQ(text.find(name), std::string::npos) << ending;
  }
}

}  // namespace
}  // namespace ccdt
