// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/evaluate.h"
#include "io/statistics.h"

namespace darkling {

// Pairs of the source that could not be used, by what was wrong, and one oddity of those that
// could.
struct SourceFaults {
  std::int64_t unreadable = 0;
  std::int64_t wrong_size = 0;
  std::int64_t unpaired = 0;
  std::int64_t stamps_not_increasing = 0;
};

// All there is to tell about a run when it is over.
struct RunReport {
  std::string source;  // as the user named it
  bool was_interrupted = false;
  Statistics statistics;
  SourceFaults faults;
  std::string truth;                     // where it came from; empty when there is none
  std::optional<Evaluation> evaluation;  // against the truth
  std::string kernels;
  int width_px = 0;
  int height_px = 0;
  std::int64_t arena_bytes = 0;
  std::optional<std::int64_t> heap_calls_after_start;  // by the odometry; nothing where not counted
  std::optional<std::int64_t> peak_rss_bytes;
  std::string trajectory_sha256;     // over the KITTI rows of the whole run
  std::vector<std::string> outputs;  // files written, with what they are: "trajectory  a.txt (tum)"
};

// The content of a --stats file. Keys are a contract; what does not apply is null.
[[nodiscard]] std::string format_statistics_json(const RunReport& report);

// A short table for a person.
[[nodiscard]] std::string format_summary(const RunReport& report);

// The same figures, without a run around them.
[[nodiscard]] std::string format_evaluation_json(const Evaluation& evaluation);
[[nodiscard]] std::string format_evaluation_table(const Evaluation& evaluation);

}  // namespace darkling
