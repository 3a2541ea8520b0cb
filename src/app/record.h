// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "drivers/injection/injection.h"
#include "io/config.h"

namespace darkling {

struct RecordOptions {
  std::string output;      // a frame log
  bool is_forced = false;  // write over what is there
  std::string config_path;
  std::vector<ConfigSetting> settings;
  std::vector<Injection> injections;
  // Which of these is reached first ends it; else a stop.
  std::optional<Duration> duration;         // from the first pair on
  std::optional<std::int64_t> frame_count;  // whole pairs
};

// Writes what the configured camera delivers to a frame log, and prints what was written. Whatever
// ends it, what was written is a whole log.
// @return the exit status; kDeviceUnavailable when there is no camera, it delivers nothing or goes
//         away; kUsage when the log cannot be written or there is one already; what is wrong with
//         the configuration.
[[nodiscard]] Result<int> record(const RecordOptions& options);

}  // namespace darkling
