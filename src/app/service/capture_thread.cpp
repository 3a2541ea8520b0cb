// SPDX-License-Identifier: Apache-2.0
#include "app/service/capture_thread.h"

#include <algorithm>
#include <utility>

#include "app/service/journal.h"
#include "platform/realtime.h"

namespace darkling {

namespace {

constexpr Duration kWait = std::chrono::milliseconds(100);
constexpr Duration kOpening = std::chrono::seconds(10);  // a USB camera may take seconds
// A lost camera is looked for soon, then less often; but one that is back is to track within 2 s.
constexpr Duration kFirstBackOff = std::chrono::milliseconds(500);
constexpr Duration kLastBackOff = std::chrono::milliseconds(1500);

std::string describe_loss(const FrameSource& source) {
  std::string text = "the camera went away";
  for (const std::string& remark : source.remarks()) text += "; " + remark;
  return text;
}

}  // namespace

CaptureThread::CaptureThread(const Links& links, int realtime_priority)
    : links_(links), thread_([this, realtime_priority] { serve(realtime_priority); }) {}

CaptureThread::~CaptureThread() {
  stop();
}

void CaptureThread::stop() {
  is_stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

std::string CaptureThread::last_error() const {
  const std::lock_guard lock(mutex_);
  return last_error_;
}

void CaptureThread::note(const std::string& error) {
  const std::lock_guard lock(mutex_);
  last_error_ = error;
}

void CaptureThread::serve(int realtime_priority) {
  name_thread("capture");
  if (realtime_priority > 0) report_wish("realtime_priority", request_realtime(realtime_priority));
  Duration back_off = kFirstBackOff;
  while (!is_stopping_ && !links_.status.is_source_over) {
    if (open()) {
      back_off = kFirstBackOff;
      capture();
      close();
      continue;
    }
    pause(back_off);
    back_off = std::min(2 * back_off, kLastBackOff);
  }
  while (!is_stopping_) pause(kWait);
}

bool CaptureThread::open() {
  PipelineStatus& status = links_.status;
  status.capture_heartbeat.expect_until(kOpening);
  const Result<void> started = links_.source.start();
  status.capture_heartbeat.beat();
  status.is_first_opening = false;
  note(started ? "" : started.error().message);
  if (!started) return false;
  status.camera_openings.add();
  status.is_camera_open = true;
  for (const std::string& remark : links_.source.remarks()) report_info("camera: " + remark);
  return true;
}

// Every lease comes back first: buffers that are given up must not be looked at any more.
void CaptureThread::close() {
  PipelineStatus& status = links_.status;
  status.is_camera_open = false;
  while (status.pairs_in_flight.load(std::memory_order_acquire) > 0) {
    links_.tracker.notify();
    status.capture_heartbeat.beat();
    static_cast<void>(sleep_until(read_monotonic_clock() + std::chrono::milliseconds(1)));
  }
  links_.source.stop();
}

// Until the source is lost or over, or a stop is asked for.
void CaptureThread::capture() {
  PipelineStatus& status = links_.status;
  while (!is_stopping_) {
    status.capture_heartbeat.beat();
    WaitResult next = links_.source.wait_next(kWait);
    if (next.status == WaitStatus::kEndOfSource) {
      status.is_source_over = true;
      return;
    }
    if (next.status == WaitStatus::kDeviceLost) return note(describe_loss(links_.source));
    if (next.status != WaitStatus::kFrame && next.status != WaitStatus::kBadFrame) continue;
    status.pairs_in.add();
    status.pairs_in_flight.fetch_add(1, std::memory_order_relaxed);
    if (!links_.pairs.try_push(std::move(next))) {
      status.pairs_in_flight.fetch_sub(1, std::memory_order_relaxed);
      status.pairs_refused.add();
    }
    links_.tracker.notify();
  }
}

void CaptureThread::pause(Duration time) {
  const MonotonicTime until = read_monotonic_clock() + time;
  while (!is_stopping_ && read_monotonic_clock() < until) {
    links_.status.capture_heartbeat.beat();
    const Duration left = until - read_monotonic_clock();
    static_cast<void>(sleep_until(read_monotonic_clock() + std::min(left, kWait)));
  }
}

}  // namespace darkling
