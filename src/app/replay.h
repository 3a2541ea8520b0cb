// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/open_source.h"
#include "app/pacer.h"
#include "app/run_outputs.h"
#include "base/result.h"
#include "drivers/injection/injection.h"
#include "io/config.h"

namespace darkling {

// `darkling replay`, its options understood but not yet tried.
struct ReplayOptions {
  std::string source;
  OpenOptions frames;
  std::vector<Injection> injections;
  std::string config_path;  // empty: the defaults
  std::vector<ConfigSetting> settings;
  std::string kernels = "auto";
  std::string truth_path;  // empty: what the recording carries
  TruthNoise truth_noise;
  Pace pace = Pace::kFast;
  OutputOptions outputs;
  std::string log_path;  // empty: none
};

// Plays a recording through the odometry and prints a summary.
// @return the exit status: 0 done, kInterruptedStatus; or any Error of the parts.
[[nodiscard]] Result<int> replay(const ReplayOptions& options);

}  // namespace darkling
