// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "io/config.h"

namespace darkling {

// What `darklingd` was told to do.
struct ServiceOptions {
  std::string config_path;  // empty: the defaults
  std::vector<ConfigSetting> settings;
};

// Runs until a stop is asked for, or a recording that stands in for a camera is over. SIGHUP makes
// it read the configuration again; one that is wrong changes nothing.
// @return the exit status, or what is wrong with the configuration at the start.
[[nodiscard]] Result<int> run_service(const ServiceOptions& options);

}  // namespace darkling
