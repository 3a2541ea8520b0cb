// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/libcamera_stream.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "drivers/libcamera/sensor_stamp.h"
#include "platform/clocks.h"

namespace darkling {

namespace {

// Said in place of an error number when no call failed.
constexpr const char* kGone = "it has gone";
constexpr const char* kSilent = "it brings no more frames";
constexpr const char* kForeignBuffer = "it completed a request that was not queued";

}  // namespace

LibcameraStream::LibcameraStream(std::string id, const LibcameraCalls& calls,
                                 std::unique_ptr<CompletedFrames> completed,
                                 std::unique_ptr<RequestCamera> camera)
    : id_(std::move(id)),
      calls_(calls),
      completed_(std::move(completed)),
      camera_(std::move(camera)),
      period_(camera_->setup().period) {
  const int count = camera_->setup().buffer_count;
  CHECK(count > 0 && count <= static_cast<int>(is_queued_.size()), "so many buffers have a place");
}

Result<void> LibcameraStream::stream_on() {
  int error = camera_->start();
  for (int buffer = 0; buffer < camera_->setup().buffer_count && error == 0; ++buffer) {
    error = queue(buffer);
  }
  if (error == 0) return {};
  return failure(ExitCode::kDeviceUnavailable,
                 "libcamera camera \"" + id_ + "\": cannot be started: " + std::strerror(-error));
}

int LibcameraStream::queue(int buffer) {
  if (queued_count() == 0) waiting_since_ = calls_.now();  // it had nothing to fill
  // Before the call: the frame may complete within it.
  is_queued_[buffer] = true;
  const int error = camera_->queue(buffer);
  if (error != 0) is_queued_[buffer] = false;
  return error;
}

TakenFrame LibcameraStream::take() {
  if (is_lost()) return {.taken = Taken::kLost};
  const auto completed = completed_->pop();
  if (!completed) {
    const bool is_gone = completed_->is_disconnected();
    if (!is_gone && !is_silent()) return {.taken = Taken::kNothing};
    lose(is_gone ? kGone : kSilent, 0);
    return {.taken = Taken::kLost};
  }
  waiting_since_ = calls_.now();
  const int buffer = completed->buffer;
  if (buffer < 0 || buffer >= camera_->setup().buffer_count || !is_queued_[buffer]) {
    lose(kForeignBuffer, 0);
    return {.taken = Taken::kLost};
  }
  is_queued_[buffer] = false;
  TakenFrame frame = {.taken = Taken::kFrame, .buffer = buffer, .sequence = completed->sequence};
  note(*completed, frame);
  if (completed->is_whole) {
    camera_->begin_reading(buffer);
  } else {
    give_back(buffer);
    frame.taken = is_lost() ? Taken::kLost : Taken::kBadBuffer;
    frame.buffer = -1;
  }
  return frame;
}

bool LibcameraStream::is_silent() const {
  const Duration silence = std::max<Duration>(kLeastSilence, 4 * period_);
  return queued_count() > 0 && calls_.now() > waiting_since_ + silence;
}

void LibcameraStream::note(const CompletedFrame& frame, TakenFrame& taken) {
  if (frame.exposure_ms >= 0.0) exposure_ms_ = frame.exposure_ms;
  if (frame.gain >= 0.0) gain_ = frame.gain;
  if (frame.period > Duration::zero()) period_ = frame.period;
  const FrameTime arrival = frame_time_from_ns(to_ns(frame.arrival));
  const SensorStamp said = stamp_frame(frame, read_suspended_time(), exposure_ms_);
  stamp_source_ = said.source;
  taken.is_of_future = said.is_of_future;
  taken.stamp = said.is_of_future ? arrivals_.estimate(arrival, said.middle)
                                  : arrivals_.note(said.middle, arrival);
}

void LibcameraStream::give_back(int buffer) {
  if (is_lost()) return;
  CHECK(!is_queued_[buffer], "a buffer is given back once");
  if (const int error = queue(buffer); error != 0) lose("queueing a request", error);
}

void LibcameraStream::lose(const char* call, int error) {
  lost_call_ = call;
  lost_error_ = error;
}

std::string LibcameraStream::loss() const {
  CHECK(is_lost(), "only a lost camera says how it was lost");
  const std::string text = "libcamera camera \"" + id_ + "\": lost, " + lost_call_;
  return lost_error_ == 0 ? text : text + ": " + std::strerror(-lost_error_);
}

int LibcameraStream::queued_count() const {
  return static_cast<int>(std::count(is_queued_.begin(), is_queued_.end(), true));
}

CameraState LibcameraStream::state() const {
  CameraState state;
  state.exposure_ms = exposure_ms_;
  state.gain = gain_;
  state.rate_hz = period_ > Duration::zero() ? 1e9 / static_cast<double>(period_.count()) : -1.0;
  state.stamp_source = stamp_source_;
  state.stamp_uncertainty = sensor_stamp_uncertainty(stamp_source_, exposure_ms_, period_);
  return state;
}

}  // namespace darkling
