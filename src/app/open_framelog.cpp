// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/open_dataset.h"
#include "app/truth_record.h"
#include "drivers/framelog/framelog_source.h"

namespace darkling {

namespace {

namespace fs = std::filesystem;

std::vector<FrameLogRow> select(const std::vector<FrameLogRow>& rows, const OpenOptions& options) {
  std::vector<FrameLogRow> selected;
  const auto end = std::min(static_cast<std::int64_t>(rows.size()), options.last);
  for (std::int64_t i = options.first; i < end;) {
    selected.push_back(rows[static_cast<std::size_t>(i)]);
    if (options.stride >= end - i) break;  // the sum below cannot overflow
    i += options.stride;
  }
  return selected;
}

// Those before the pairs that are played: a pair that is left out takes its wishes along.
std::vector<RecordedWish> select(std::vector<RecordedWish> wishes,
                                 const std::vector<FrameLogRow>& selected) {
  std::erase_if(wishes, [&](const RecordedWish& wish) {
    return !std::ranges::binary_search(selected, wish.sequence, {}, &FrameLogRow::sequence);
  });
  return wishes;
}

}  // namespace

bool is_frame_log(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status) || fs::is_directory(status)) return false;
  if (fs::path(path).extension() == ".lcmlog") return true;
  if (!fs::is_regular_file(status)) return false;
  std::string start(4, '\0');
  return std::ifstream(path, std::ios::binary).read(start.data(), 4) && start == "\xed\xa1\xda\x01";
}

Result<Recording> open_framelog(const std::string& path, const OpenOptions& options) {
  auto log = open_frame_log(path);
  if (!log) return tl::unexpected(log.error());
  std::vector<FrameLogRow> selected = select(log->rows, options);
  if (log->rows.empty()) return failure(ExitCode::kBadInput, path + ": holds no frames");
  if (selected.empty()) {
    return failure(ExitCode::kUsage, path + ": frames from " + std::to_string(options.first) +
                                         " on are asked for, it holds frames 0 to " +
                                         std::to_string(log->rows.size() - 1));
  }
  Recording recording;
  recording.name = fs::path(path).filename().string();
  recording.kind = "frame log";
  recording.rig = log->rig;
  recording.calibration_path = path;
  recording.frame_count = static_cast<std::int64_t>(selected.size());
  if (log->truth) recording.truth = from_truth_record(*log->truth);
  RecordedWishes recorded = read_wishes(*log);
  recording.wishes = select(std::move(recorded.wishes), selected);
  log->damaged_records += recorded.unreadable;
  recording.damage = describe_damage(*log);
  recording.source = std::make_unique<FramelogSource>(std::move(log->events), std::move(selected));
  return recording;
}

}  // namespace darkling
