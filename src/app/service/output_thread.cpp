// SPDX-License-Identifier: Apache-2.0
#include "app/service/output_thread.h"

#include <algorithm>

#include "app/service/journal.h"
#include "messages/channels.h"
#include "platform/clocks.h"
#include "platform/process_memory.h"
#include "platform/realtime.h"

namespace darkling {

namespace {

constexpr Duration kStatusPeriod = std::chrono::milliseconds(500);
constexpr Duration kWait = std::chrono::milliseconds(50);

double to_ms(Duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

}  // namespace

OutputThread::OutputThread(const Links& links, const PipelineFacts& facts,
                           const ServiceConfig& config)
    : links_(links),
      facts_(facts),
      started_at_(read_monotonic_clock()),
      has_bot_core_pose_(config.bot_core_pose),
      reset_counter_(facts.first_reset_counter),
      publisher_(config.lcm_url, config.channel_prefix),
      health_(started_at_, facts.period),
      status_at_(started_at_),
      thread_([this] { serve(); }) {}

OutputThread::~OutputThread() {
  is_stopping_ = true;
  links_.own.notify();
  thread_.join();
}

void OutputThread::serve() {
  name_thread("output");
  status_.kernels = facts_.kernels;
  status_.version = facts_.version;
  status_.camera = facts_.camera;
  publisher_.open_when_due(started_at_);
  for (bool is_last = false; !is_last;) {
    is_last = is_stopping_;
    static_cast<void>(links_.own.wait(is_last ? Duration::zero() : kWait));
    while (std::optional<TrackedFrame> tracked = links_.estimates.try_pop()) {
      publish(*tracked);
    }
    const MonotonicTime now = read_monotonic_clock();
    links_.status.output_heartbeat.beat();
    publisher_.open_when_due(now);
    if (!links_.status.is_stopping) judge(now);
    if (is_last || now - status_at_ >= kStatusPeriod) publish_status(now);
  }
}

void OutputThread::publish(TrackedFrame& tracked) {
  Estimate& estimate = tracked.estimate;
  estimate.reset_counter += facts_.first_reset_counter;
  reset_counter_ = estimate.reset_counter;
  messages_.fill(estimate, wall_clock_.update());
  publisher_.publish(kUpdateChannel, messages_.update());
  publisher_.publish(kPoseChannel, messages_.pose());
  if (has_bot_core_pose_) publisher_.publish(kBotCorePoseChannel, messages_.bot_core_pose());
  const MonotonicTime now = read_monotonic_clock();
  const Duration late = now.time_since_epoch() - estimate.stamp.time_since_epoch();
  latency_.add(late);
  deadline_misses_ += late > facts_.period ? 1 : 0;
  health_.observe(estimate, now);
  if (tracked.is_bad) return;
  ++(estimate.status == TrackStatus::kLost ? frames_lost_ : frames_tracked_);
}

void OutputThread::judge(MonotonicTime now) {
  const PipelineStatus& pipeline = links_.status;
  const ServiceState before = state_;
  const Health::Camera camera = pipeline.is_camera_open     ? Health::Camera::kOpen
                                : pipeline.is_first_opening ? Health::Camera::kOpening
                                                            : Health::Camera::kAbsent;
  state_ = health_.judge(now, camera, pipeline.are_threads_alive(now));
  if (state_ == before) return;
  tell_state(now);
  const bool is_trouble = state_ == ServiceState::kLost || state_ == ServiceState::kFault;
  if (is_trouble && links_.recorder != nullptr) links_.recorder->write_black_box();
}

void OutputThread::tell_state(MonotonicTime now) {
  std::string line = std::string("state=") + name_of(state_);
  if (state_ == ServiceState::kNoCamera) {
    const std::string error = links_.capture.last_error();
    if (!error.empty()) line += " error=\"" + error + "\"";
  }
  const auto uptime = std::chrono::duration<double>(now - started_at_);
  char more[96];
  std::snprintf(more, sizeof(more), " frames=%lld uptime_s=%.1f",
                static_cast<long long>(links_.status.pairs_in.get()), uptime.count());
  line += more;
  const bool is_well = state_ == ServiceState::kTracking || state_ == ServiceState::kInit;
  if (is_well) {
    report_info(line);
  } else {
    report_warning(line);
  }
  links_.status.state_line.set(line);
}

// What counts from when the counters were last zeroed.
void OutputThread::fill_counts() {
  const PipelineStatus& pipeline = links_.status;
  const SourceStats source = links_.source.stats();
  status_.frames_in = pipeline.pairs_in.get();
  status_.frames_tracked = frames_tracked_;
  status_.frames_lost = frames_lost_;
  status_.frames_skipped = pipeline.pairs_skipped.get() + pipeline.pairs_refused.get();
  status_.frames_unpaired = source.unpaired;
  status_.frames_bad = source.unreadable + source.wrong_size;
  status_.device_dropped = source.dropped_by_device;
  status_.device_errors = source.device_errors + source.stamps_of_future;
  status_.publish_failures = publisher_.failures();
  status_.deadline_misses = deadline_misses_;
  status_.refinement_overruns = pipeline.refinement_overruns.get();
  status_.wall_clock_steps = wall_clock_.steps();
  constexpr std::array kCounts = {
      &status_t::frames_in,       &status_t::frames_tracked,      &status_t::frames_lost,
      &status_t::frames_skipped,  &status_t::frames_unpaired,     &status_t::frames_bad,
      &status_t::device_dropped,  &status_t::device_errors,       &status_t::publish_failures,
      &status_t::deadline_misses, &status_t::refinement_overruns, &status_t::wall_clock_steps,
  };
  const bool is_zeroing = is_zeroing_wanted_.exchange(false);
  for (const auto count : kCounts) {
    if (is_zeroing) zero_.*count = status_.*count;
    status_.*count -= zero_.*count;
  }
}

void OutputThread::fill_camera() {
  const CameraState camera = links_.source.camera_state();
  status_.exposure_ms = camera.exposure_ms;
  status_.gain = camera.gain;
  status_.skew_ms = to_ms(camera.last_skew);
  status_.stamp_source = static_cast<std::int8_t>(camera.stamp_source);
  status_.stamp_uncertainty_ms = to_ms(camera.stamp_uncertainty);
}

void OutputThread::fill_recording() {
  const Recorder* recorder = links_.recorder;
  if (recorder == nullptr) return;
  status_.is_recording = recorder->is_recording() ? 1 : 0;
  status_.recorded_frames = recorder->recorded();
  status_.record_drops = recorder->drops();
  const std::int64_t not_recorded = recorder->drops() + recorder->failures();
  if (std::exchange(not_recorded_before_, not_recorded) != not_recorded) {
    health_.observe(kReasonRecordingFailed);
  }
}

void OutputThread::publish_status(MonotonicTime now) {
  const PipelineStatus& pipeline = links_.status;
  const Duration epoch_offset = wall_clock_.update();
  status_.mono_ns = to_ns(now);
  status_.utime = (now.time_since_epoch() + epoch_offset).count() / 1000;
  status_.state = static_cast<std::int8_t>(state_);
  const std::int64_t skipped = pipeline.pairs_skipped.get() + pipeline.pairs_refused.get();
  if (std::exchange(skipped_before_, skipped) != skipped) health_.observe(kReasonLate);
  const std::int64_t steps_before = status_.wall_clock_steps;
  const std::int64_t failures_before = status_.publish_failures;
  fill_counts();
  if (status_.wall_clock_steps > steps_before) health_.observe(kReasonClockStepped);
  if (status_.publish_failures > failures_before) health_.observe(kReasonNotPublished);
  fill_recording();
  status_.reasons = static_cast<std::int32_t>(health_.take_reasons());
  status_.reset_counter = reset_counter_;
  status_.uptime_s = std::chrono::duration<double>(now - started_at_).count();
  const double seconds = std::chrono::duration<double>(now - status_at_).count();
  const std::int64_t pairs_in = pipeline.pairs_in.get();
  const std::int64_t estimates = frames_tracked_ + frames_lost_;
  status_.rate_in_hz = static_cast<double>(pairs_in - pairs_in_before_) / seconds;
  status_.rate_out_hz = static_cast<double>(estimates - estimates_before_) / seconds;
  pairs_in_before_ = pairs_in;
  estimates_before_ = estimates;
  status_.latency_p50_ms = latency_.is_empty() ? -1.0 : to_ms(latency_.median());
  status_.latency_max_ms = latency_.is_empty() ? -1.0 : to_ms(latency_.most());
  latency_.clear();
  fill_camera();
  status_.arena_bytes = facts_.arena_bytes;
  status_.rss_bytes = read_rss_bytes().value_or(0);
  status_.heap_calls = pipeline.heap_calls.get();
  status_.width = facts_.width_px;
  status_.height = facts_.height_px;
  status_at_ = now;
  publisher_.publish(kStatusChannel, status_);
}

}  // namespace darkling
