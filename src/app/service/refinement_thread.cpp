// SPDX-License-Identifier: Apache-2.0
#include "app/service/refinement_thread.h"

#include "base/check.h"

namespace darkling {

RefinementThread::~RefinementThread() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RefinementThread::start(Job job, void* context) {
  {
    const std::lock_guard lock(mutex_);
    CHECK(job_ == nullptr, "a refinement is waited for before the next one starts");
    job_ = job;
    context_ = context;
  }
  changed_.notify_all();
}

bool RefinementThread::wait() {
  std::unique_lock lock(mutex_);
  const bool was_done = job_ == nullptr;
  changed_.wait(lock, [this] { return job_ == nullptr; });
  return was_done;
}

void RefinementThread::serve() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return job_ != nullptr || is_stopping_; });
    if (job_ == nullptr) return;
    lock.unlock();
    job_(context_);
    lock.lock();
    job_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace darkling
