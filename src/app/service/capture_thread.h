// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>
#include <thread>

#include "app/service/pipeline_status.h"
#include "base/spsc_ring.h"
#include "drivers/frame_source.h"
#include "platform/wake_up.h"

namespace darkling {

// At least as many as a driver leases.
inline constexpr std::size_t kPairRingSize = 8;
using PairRing = SpscRing<WaitResult, kPairRingSize>;

// Takes pairs from a source and hands them over, and opens the source again when it is lost.
class CaptureThread {
 public:
  struct Links {
    FrameSource& source;
    PairRing& pairs;
    WakeUp& tracker;  // woken for every pair
    PipelineStatus& status;
  };
  // @param realtime_priority  0: none is asked for.
  CaptureThread(const Links& links, int realtime_priority);
  ~CaptureThread();
  CaptureThread(const CaptureThread&) = delete;
  CaptureThread& operator=(const CaptureThread&) = delete;

  // Closes the source. Takes no longer than one wait for a frame, or what the device takes to open.
  void stop();
  // Why the source could not be opened the last time; empty once it is. Thread: any.
  [[nodiscard]] std::string last_error() const;

 private:
  void serve(int realtime_priority);
  bool open();
  void close();
  void capture();
  void pause(Duration time);
  void note(const std::string& error);

  Links links_;
  std::atomic<bool> is_stopping_ = false;
  mutable std::mutex mutex_;  // guards last_error_
  std::string last_error_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace darkling
