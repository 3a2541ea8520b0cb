// SPDX-License-Identifier: Apache-2.0
#include "app/unknown_words.h"

#include <algorithm>
#include <string_view>

#include <CLI/CLI.hpp>

#include "base/nearest.h"

namespace darkling {

namespace {

tl::unexpected<Error> unknown(const std::string& what, const std::string& word,
                              const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  return failure(ExitCode::kUsage,
                 "unknown " + what + " '" + word + "'" + did_you_mean(word, names));
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

Result<void> check_options(const CLI::App& command, const std::vector<std::string>& words,
                           std::size_t first) {
  const std::vector<std::string> names = option_names(command);
  for (std::size_t i = first; i < words.size(); ++i) {
    if (words[i] == "--") return {};  // what follows are no options
    if (!words[i].starts_with("--")) continue;
    const std::string name = words[i].substr(0, words[i].find('='));
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      return unknown("option", name, names);
    }
  }
  return {};
}

}  // namespace

Result<void> check_words(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.empty()) return {};
  if (words[0].starts_with('-')) return check_options(app, {words[0]}, 0);
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) {
    if (verb->get_name() == words[0]) return check_options(*verb, words, 1);
    verbs.push_back(verb->get_name());
  }
  return unknown("verb", words[0], verbs);
}

}  // namespace darkling
