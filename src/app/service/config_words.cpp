// SPDX-License-Identifier: Apache-2.0
#include "app/service/config_words.h"

#include <CLI/CLI.hpp>

namespace darkling {

std::vector<ConfigSetting> ConfigWords::settings() const {
  std::vector<ConfigSetting> settings;
  for (const std::string& text : texts) settings.push_back({"--set", text});
  return settings;
}

void declare_config_options(CLI::App& command, ConfigWords& words) {
  command.add_option("--config", words.path, "Configuration file (YAML)")->type_name("FILE");
  command.add_option("--set", words.texts, "One key of the configuration; repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

}  // namespace darkling
