// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/replay_status.h"
#include "app/service/wish_messages.h"
#include "base/result.h"
#include "drivers/framelog/frame_log_writer.h"
#include "geometry/stereo_rig.h"
#include "io/config.h"
#include "io/messages.h"
#include "io/trajectory.h"

namespace darkling {

// What a run saw and said, as one frame log: every pair as the odometry got it and what it was
// asked for, each followed by the messages that the service would publish. It replays like any
// other frame log, to the same poses. Thread: one.
class ReplayLog {
 public:
  // Creates the file; nothing is written over. Where the name is taken, it is as claim_file() makes
  // of it.
  // @param rig    of the pairs.
  // @param truth  of the run, where there is one.
  // @return kUsage when the file cannot be written.
  [[nodiscard]] static Result<ReplayLog> create(const std::string& path, const Config& config,
                                                const StereoRig& rig,
                                                const std::optional<Trajectory>& truth,
                                                const ReplayFacts& facts);

  // One pair, or what is known of a missing one.
  // @param obeyed    what the odometry was asked for before it.
  // @param estimate  that came of it.
  // @return kUsage when the disk is full; what was written before stays a whole log.
  Result<void> add(const WaitResult& pair, std::span<const RecordedWish> obeyed,
                   const Estimate& estimate);
  Result<void> close();

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  ReplayLog(std::string path, FrameLogWriter writer, const Config& config,
            const ReplayFacts& facts);
  template <class Message>
  Result<void> publish(std::string_view channel, const Message& message, FrameTime stamp);
  Result<void> publish(const Estimate& estimate);
  Result<void> publish(const std::optional<status_t>& status, FrameTime stamp);

  std::string path_;
  FrameLogWriter writer_;
  std::string prefix_;  // of the channels
  bool has_bot_core_pose_;
  EstimateMessages messages_;
  ReplayStatus status_;
  FrameTime last_stamp_;
};

}  // namespace darkling
