// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "vo/refinement_runner.h"

namespace darkling {

// Refines on a thread of its own, so that what is measured of a keyframe can be published first.
// Nothing is allocated after the thread has started.
class RefinementThread final : public RefinementRunner {
 public:
  RefinementThread() : thread_([this] { serve(); }) {}
  // Waits for the job at hand.
  ~RefinementThread() override;
  RefinementThread(const RefinementThread&) = delete;
  RefinementThread& operator=(const RefinementThread&) = delete;

  void start(Job job, void* context) override;
  bool wait() override;

 private:
  void serve();

  std::mutex mutex_;
  std::condition_variable changed_;
  Job job_ = nullptr;  // null: idle
  void* context_ = nullptr;
  bool is_stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace darkling
