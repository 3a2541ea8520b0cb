// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/service/odometry_thread.h"
#include "app/service/pipeline_status.h"
#include "drivers/framelog/frame_log_writer.h"
#include "geometry/stereo_rig.h"
#include "io/config.h"
#include "platform/wake_up.h"

namespace darkling {

// Keeps the last pairs in memory and writes them to frame logs: all of them while recording, those
// of the last seconds (the black box) when something went wrong. It never makes the odometry wait:
// what the disk does not take in time is left out and counted.
class Recorder final : public PairObserver {
 public:
  // @param rig  with which the pairs are taken.
  // @pre config.service.record_to is not empty.
  Recorder(const Config& config, const StereoRig& rig, const std::string& source);
  ~Recorder() override;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Writes what is waiting and closes the log; what was recorded can still be asked for. @pre no
  // pair comes any more.
  void stop();

  // Thread of the next two: that of the odometry. No heap call.
  void on_pair(const WaitResult& pair, const Estimate& estimate) override;
  void on_wish(const Wish& wish) override;

  // Thread of the following: any.
  void start_recording();
  void stop_recording();
  // Does nothing when black_box_s is 0, or the last one was written less than ten seconds ago.
  void write_black_box();

  [[nodiscard]] bool is_recording() const { return is_recording_; }
  [[nodiscard]] std::int64_t recorded() const { return recorded_.get(); }
  // Pairs and wishes that were left out: a replay of the rest differs.
  [[nodiscard]] std::int64_t drops() const { return drops_.get(); }
  // An error ended a recording.
  [[nodiscard]] std::int64_t failures() const { return failures_.get(); }

 private:
  using Wishes = std::array<Wish, kWishRingSize>;
  // One pair and what was asked for before it.
  struct Slot {
    enum class State { kFree = 0, kFilled, kWriting };
    std::atomic<State> state = State::kFree;
    std::int64_t number = 0;  // counts pairs
    FrameFault fault = FrameFault::kNone;
    StereoFrame frame;  // of the two below; without pixels when there is a fault
    std::vector<std::uint8_t> left;
    std::vector<std::uint8_t> right;
    Wishes wishes;
    std::size_t wish_count = 0;
  };
  enum class Purpose { kRecording, kBlackBox };

  void serve();
  [[nodiscard]] std::optional<FrameLogWriter> create(Purpose purpose);
  // Writes the pairs from `from` up to `to` that are still there.
  // @return how many those were; nothing after an error, which is reported.
  std::optional<std::int64_t> write(FrameLogWriter& log, std::int64_t from, std::int64_t to);
  Result<void> write_slot(FrameLogWriter& log, Slot& slot);
  void begin_when_wanted();
  void record_new_pairs();
  void dump_black_box();
  void fail(const std::string& error);

  const Config config_;
  const StereoRig rig_;
  const std::string source_;
  std::vector<Slot> slots_;
  Wishes wishes_;  // since the last pair
  std::size_t wish_count_ = 0;

  std::atomic<std::int64_t> next_ = 0;       // pairs so far
  std::atomic<std::int64_t> unwritten_ = 0;  // the first that a recording still needs
  std::atomic<bool> is_recording_wanted_ = false;
  std::atomic<bool> is_recording_ = false;
  std::atomic<bool> is_black_box_wanted_ = false;
  std::atomic<bool> is_stopping_ = false;
  Count recorded_;
  Count drops_;
  Count failures_;
  std::optional<FrameLogWriter> log_;  // of the recording
  MonotonicTime black_box_at_;
  WakeUp wake_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace darkling
