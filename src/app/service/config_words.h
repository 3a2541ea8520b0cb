// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "io/config.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a name of CLI11
class App;
}

namespace darkling {

// What was typed about the configuration.
struct ConfigWords {
  std::string path;
  std::vector<std::string> texts;  // "key=value"

  [[nodiscard]] std::vector<ConfigSetting> settings() const;
};

// Adds --config and --set, the same for every program and verb that has a configuration.
void declare_config_options(CLI::App& command, ConfigWords& words);

}  // namespace darkling
