// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/dataset_layout.h"
#include "app/open_source.h"
#include "base/result.h"
#include "drivers/injection/injection.h"

namespace darkling {

struct ConvertOptions {
  std::string source;
  OpenOptions frames;
  std::vector<Injection> injections;
  std::string output;
  std::optional<DatasetLayout> layout;  // nothing: a frame log
  bool is_forced = false;               // write over what is there
};

// Writes the frames of a recording, its rig, its truth, its gaps and, into a log, what was asked of
// the odometry on the way into another one that `replay` plays. An interrupted run leaves a shorter
// recording.
// @return the exit status, kInterruptedStatus when a signal cut it short; kUsage when the output is
//         not to be written to, cannot be, or cannot hold this recording; or what open_source()
//         says.
[[nodiscard]] Result<int> run_convert(const ConvertOptions& options);

}  // namespace darkling
