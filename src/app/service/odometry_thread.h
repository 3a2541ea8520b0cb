// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "app/service/capture_thread.h"
#include "app/service/command_ring.h"
#include "app/service/pipeline_status.h"
#include "base/spsc_ring.h"
#include "platform/wake_up.h"
#include "vo/odometry.h"

namespace darkling {

inline constexpr std::size_t kEstimateRingSize = 64;
using EstimateRing = SpscRing<TrackedFrame, kEstimateRingSize>;

// Is told of every pair that is tracked, in the order and with the wishes that it was tracked with:
// played back so, the odometry gives the same bytes.
// Thread: that of the odometry; no call waits for anything.
class PairObserver {
 public:
  virtual ~PairObserver() = default;
  virtual void on_pair(const WaitResult& pair, const Estimate& estimate) = 0;
  virtual void on_wish(const Wish& wish) = 0;
};

// Tracks the newest pair there is, again and again.
class OdometryThread {
 public:
  struct Links {
    Odometry& odometry;
    PairRing& pairs;
    WishRing& wishes;
    WakeUp& own;
    EstimateRing& estimates;
    WakeUp& output;  // woken for every estimate
    PipelineStatus& status;
    PairObserver* observer;  // may be null
  };
  // @param cpu  core to stay on; -1: any.
  OdometryThread(const Links& links, int cpu);
  ~OdometryThread();
  OdometryThread(const OdometryThread&) = delete;
  OdometryThread& operator=(const OdometryThread&) = delete;

 private:
  void serve(int cpu);
  void take_wishes(FrameTime stamp);
  bool bring_to_pace(Wish& wish, FrameTime stamp) const;
  void track(const WaitResult& pair);

  Links links_;
  std::optional<FrameTime> last_stamp_;
  std::atomic<bool> is_stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace darkling
