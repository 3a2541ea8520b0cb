// SPDX-License-Identifier: Apache-2.0
#include "app/service/odometry_thread.h"

#include <utility>

#include "app/service/follow_pair.h"
#include "app/service/journal.h"
#include "app/service/obey_wish.h"
#include "platform/heap_probe.h"
#include "platform/realtime.h"

namespace darkling {

namespace {

constexpr Duration kWait = std::chrono::milliseconds(100);

}  // namespace

OdometryThread::OdometryThread(const Links& links, int cpu)
    : links_(links), thread_([this, cpu] { serve(cpu); }) {}

OdometryThread::~OdometryThread() {
  is_stopping_ = true;
  links_.own.notify();
  thread_.join();
}

void OdometryThread::serve(int cpu) {
  name_thread("odometry");
  if (cpu >= 0) report_wish("cpu", request_core(cpu));
  PipelineStatus& status = links_.status;
  const auto heap_calls_before = count_heap_calls();
  status.heap_calls.set(heap_calls_before ? 0 : -1);
  while (!is_stopping_) {
    status.odometry_heartbeat.beat();
    static_cast<void>(links_.own.wait(kWait));
    std::int64_t skipped = 0;
    std::optional<WaitResult> pair = links_.pairs.pop_newest(skipped);
    if (!pair) continue;
    status.pairs_skipped.add(skipped);
    const FrameTime stamp =
        pair->status == WaitStatus::kFrame ? pair->lease.frame().stamp : pair->stamp;
    take_wishes(stamp);
    track(*pair);
    last_stamp_ = stamp;
    pair.reset();
    status.pairs_in_flight.fetch_sub(1 + skipped, std::memory_order_release);
    status.refinement_overruns.set(links_.odometry.refinement_overruns());
    if (heap_calls_before) status.heap_calls.set(*count_heap_calls() - *heap_calls_before);
  }
}

void OdometryThread::take_wishes(FrameTime stamp) {
  while (std::optional<Wish> wish = links_.wishes.try_pop()) {
    if (wish->kind == Wish::Kind::kHint && !bring_to_pace(*wish, stamp)) continue;
    obey_wish(links_.odometry, *wish);
    if (links_.observer != nullptr) links_.observer->on_wish(*wish);
  }
}

// Makes a motion over some time one from the last pair to this one, at the same pace.
// @return false when the two spans have nothing to do with each other.
bool OdometryThread::bring_to_pace(Wish& wish, FrameTime stamp) const {
  constexpr double kMostShare = 10.0;
  if (!last_stamp_ || wish.span <= Duration::zero()) return false;
  const double share =
      static_cast<double>((stamp - *last_stamp_).count()) / static_cast<double>(wish.span.count());
  if (!(share > 0.0 && share < kMostShare)) return false;
  wish.T_previous_body = Se3::exp(share * wish.T_previous_body.log());
  wish.span = stamp - *last_stamp_;
  return true;
}

void OdometryThread::track(const WaitResult& pair) {
  TrackedFrame tracked;
  tracked.is_bad = pair.status == WaitStatus::kBadFrame;
  if (tracked.is_bad) links_.status.pairs_bad.add();
  tracked.estimate = follow_pair(links_.odometry, pair);
  const Estimate estimate = tracked.estimate;
  if (!links_.estimates.try_push(std::move(tracked))) links_.status.estimates_refused.add();
  links_.output.notify();
  if (links_.observer != nullptr) links_.observer->on_pair(pair, estimate);
}

}  // namespace darkling
