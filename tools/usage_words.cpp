#include "tools/usage_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "baselines/guess.h"

namespace ccdt::tools {
namespace {

std::string wrong_verb(const CLI::App& app) {
  const std::string remedy = "`ccdt --help` lists the verbs";
  const std::vector<std::string> words = app.remaining();
  if (words.empty()) return "ccdt: the verb is missing\n  " + remedy;
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  return "ccdt: there is no verb '" + words.front() + "'\n  " + baselines::guess(words.front(), verbs) + remedy;
}

std::string unexpected_word(const CLI::App& verb, const std::string& remedy) {
  const std::vector<std::string> words = verb.remaining();
  const auto option = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("-"); });
  if (option == words.end()) return "ccdt: unexpected argument '" + words.front() + "'\n  " + remedy;
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> names;
  for (const CLI::Option* known : verb.get_options())
    for (const std::string& long_name : known->get_lnames()) names.push_back("--" + long_name);
  return "ccdt: unknown option " + name + "\n  " + baselines::guess(name, names) + remedy;
}

}  // namespace

std::string usage_in_words(const CLI::App& app, const CLI::Error& error) {
  const std::vector<CLI::App*> verbs = app.get_subcommands();
  if (verbs.empty()) return wrong_verb(app);
  const std::string remedy = "`ccdt " + verbs.front()->get_name() + " --help` lists the options";
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !verbs.front()->remaining().empty())
    return unexpected_word(*verbs.front(), remedy);
  std::string what = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)  // "--output: 1 required TEXT missing"
    what = what.substr(0, what.find(':')) + " needs a value";
  return "ccdt: " + what + "\n  " + remedy;
}

}  // namespace ccdt::tools
