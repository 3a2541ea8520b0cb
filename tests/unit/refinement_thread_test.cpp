// SPDX-License-Identifier: Apache-2.0
#include "app/service/refinement_thread.h"

#include <cstring>
#include <thread>

#include <gtest/gtest.h>

#include "platform/clocks.h"
#include "support/kernel_cases.h"
#include "support/synthetic_run.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

constexpr char kMine[] = "mine,frames=24,width=160,seed=5,speed=1.5";

struct Counted {
  int jobs = 0;
  std::thread::id thread;
};

void count_job(void* context) {
  Counted& counted = *static_cast<Counted*>(context);
  ++counted.jobs;
  counted.thread = std::this_thread::get_id();
}

TEST(RefinementThread, DoesEveryJobOnceAndElsewhere) {
  Counted counted;
  RefinementThread thread;
  for (int i = 1; i <= 100; ++i) {
    thread.start(count_job, &counted);
    (void)thread.wait();
    ASSERT_EQ(counted.jobs, i);
  }
  EXPECT_NE(counted.thread, std::this_thread::get_id());
}

TEST(RefinementThread, SaysWhetherTheJobWasDoneBeforeItWasWaitedFor) {
  RefinementThread thread;
  EXPECT_TRUE(thread.wait()) << "nothing was started";
  std::mutex gate;
  gate.lock();
  thread.start(
      [](void* context) { const std::lock_guard lock(*static_cast<std::mutex*>(context)); }, &gate);
  std::thread opener([&gate] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    gate.unlock();
  });
  EXPECT_FALSE(thread.wait());
  EXPECT_TRUE(thread.wait());
  opener.join();
}

TEST(RefinementThread, FinishesTheJobAtHandWhenItGoes) {
  Counted counted;
  {
    RefinementThread thread;
    thread.start(count_job, &counted);
  }
  EXPECT_EQ(counted.jobs, 1);
}

// Poses of a run, bit for bit, and how many refinements were applied.
struct Played {
  std::vector<Eigen::Matrix4d> poses;
  int applied = 0;
};

Played play(RefinementRunner* runner, bool finishes_early) {
  const test::SyntheticRun& run = test::synthetic_run(kMine);
  const auto odometry =
      Odometry::create({.width_px = 160}, run.rig, KernelTable(), read_monotonic_clock, runner);
  EXPECT_TRUE(odometry) << odometry.error().message;
  Played played;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const Estimate estimate = (*odometry)->track(run.frames[i].at(static_cast<std::int64_t>(i)));
    if (finishes_early) (*odometry)->finish_refinement();
    played.poses.push_back(estimate.T_world_body.matrix());
    played.applied += estimate.refinement == Refinement::kApplied ? 1 : 0;
  }
  return played;
}

bool are_same(const Played& a, const Played& b) {
  if (a.applied != b.applied || a.poses.size() != b.poses.size()) return false;
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    if (std::memcmp(a.poses[i].data(), b.poses[i].data(), sizeof(Eigen::Matrix4d)) != 0) {
      return false;
    }
  }
  return true;
}

// Notes in what order things happen, and lets a job wait until it is waited for.
class LateRunner final : public RefinementRunner {
 public:
  void start(Job job, void* context) override {
    job_ = job;
    context_ = context;
  }
  bool wait() override {
    if (job_ == nullptr) return true;
    job_(context_);
    job_ = nullptr;
    ++done;
    return false;
  }
  [[nodiscard]] bool is_waiting() const { return job_ != nullptr; }
  int done = 0;

 private:
  Job job_ = nullptr;
  void* context_ = nullptr;
};

TEST(Refinement, IsWaitedForBeforeTheOdometryGoes) {
  const test::SyntheticRun& run = test::synthetic_run(kMine);
  LateRunner runner;
  auto odometry =
      Odometry::create({.width_px = 160}, run.rig, KernelTable(), read_monotonic_clock, &runner);
  ASSERT_TRUE(odometry) << odometry.error().message;
  for (std::size_t i = 0; i < run.frames.size() && !runner.is_waiting(); ++i) {
    (void)(*odometry)->track(run.frames[i].at(static_cast<std::int64_t>(i)));
  }
  ASSERT_TRUE(runner.is_waiting());
  const int before = runner.done;
  odometry->reset();
  EXPECT_FALSE(runner.is_waiting());
  EXPECT_EQ(runner.done, before + 1);
}

TEST(Refinement, GivesTheSamePosesWhereverAndWheneverItIsComputed) {
  const Played expected = play(nullptr, false);
  EXPECT_GE(expected.applied, 2);
  RefinementThread thread;
  EXPECT_TRUE(are_same(play(nullptr, true), expected));
  EXPECT_TRUE(are_same(play(&thread, false), expected));
  EXPECT_TRUE(are_same(play(&thread, true), expected));
}

// A refinement moves the pose, not the vehicle: little by little, and in no motion.
TEST(Refinement, IsFollowedByThePoseInSmallStepsBesideTheMotions) {
  constexpr double kMaxStep = 1e-3;  // m and rad
  const test::SyntheticRun& run = test::synthetic_run(kMine);
  const auto odometry =
      Odometry::create({.width_px = 160}, run.rig, KernelTable(), read_monotonic_clock);
  ASSERT_TRUE(odometry) << odometry.error().message;
  Se3 T_world_before;
  double largest = 0.0;
  int refined = 0;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const Estimate e = (*odometry)->track(run.frames[i].at(static_cast<std::int64_t>(i)));
    const Vector6 beside = minus(T_world_before * e.T_previous_body, e.T_world_body);
    EXPECT_LT(beside.norm(), kMaxStep) << e.sequence;
    largest = std::max(largest, beside.norm());
    refined += e.refinement == Refinement::kApplied ? 1 : 0;
    T_world_before = e.T_world_body;
  }
  EXPECT_GE(refined, 1);
  EXPECT_GT(largest, 1e-9);
}

}  // namespace
}  // namespace darkling
