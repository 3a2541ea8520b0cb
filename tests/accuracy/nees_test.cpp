// SPDX-License-Identifier: Apache-2.0
// Whether covariances keep what they promise, over many short rendered runs of every scene, speed
// and light. DARKLING_NEES_RUNS says how many; 200 take some ten minutes:
//
//   DARKLING_NEES_RUNS=200 build/release/bin/test_accuracy --gtest_filter=Nees.*
#include "io/nees.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "support/kernel_cases.h"
#include "support/synthetic_run.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using test::SyntheticRun;

MonotonicTime stopped_clock() {
  return MonotonicTime();
}

constexpr std::array<const char*, 3> kScenes = {"mine", "quarry", "corridor"};
constexpr std::array<const char*, 5> kElectrons = {"4000", "1500", "700", "300", "4000"};
constexpr std::array<const char*, 4> kSpeeds = {"0.9", "0.4", "1.4", "2"};

// Of motions from frame to frame, and of the poses at the ends of runs.
struct Consistency {
  NeesMean motion;
  NeesMean end;
};

void track(const SyntheticRun& run, Consistency& consistency) {
  const auto odometry =
      Odometry::create({.width_px = 160}, run.rig, test::available_tables().back(), stopped_clock);
  ASSERT_TRUE(odometry) << odometry.error().message;
  Estimate estimate;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    estimate = (*odometry)->track(run.frames[i].at(static_cast<std::int64_t>(i)));
    if (i == 0) continue;
    const Se3 T_previous_body = run.T_world_body[i - 1].inverse() * run.T_world_body[i];
    consistency.motion.add(minus(estimate.T_previous_body, T_previous_body),
                           estimate.cov_previous_body);
  }
  const Se3 T_first_last = run.T_world_body.front().inverse() * run.T_world_body.back();
  consistency.end.add(minus(estimate.T_world_body, T_first_last), estimate.cov_world_body);
}

void print(const char* scene, const char* what, const std::optional<Nees>& nees) {
  if (!nees) return;
  std::printf("%-9s %-7s %5d  %5.2f  %5.2f  %5.2f  %5.1f %%\n", scene, what, nees->count,
              nees->mean, nees->translation, nees->rotation, 100.0 * nees->share_beyond);
}

TEST(Nees, IsAboutOneForMotionsAndForTheEndsOfRuns) {
  const char* wanted = std::getenv("DARKLING_NEES_RUNS");
  const int runs = wanted != nullptr ? std::atoi(wanted) : 12;
  Consistency all;
  std::array<Consistency, kScenes.size()> of_scene;
  for (int i = 0; i < runs; ++i) {
    const std::size_t scene = static_cast<std::size_t>(i) % kScenes.size();
    const std::string text =
        std::string(kScenes[scene]) + ",frames=16,width=160,seed=" + std::to_string(100 + i) +
        ",electrons=" + kElectrons[static_cast<std::size_t>(i) % kElectrons.size()] +
        ",speed=" + kSpeeds[static_cast<std::size_t>(i) % kSpeeds.size()];
    const SyntheticRun& run = test::synthetic_run(text);
    track(run, all);
    track(run, of_scene[scene]);
  }
  std::printf("scene     what    count   NEES  trans    rot  beyond 3 sigma\n");
  for (std::size_t scene = 0; scene < kScenes.size(); ++scene) {
    print(kScenes[scene], "motion", of_scene[scene].motion.mean());
    print(kScenes[scene], "end", of_scene[scene].end.mean());
  }
  print("all", "motion", all.motion.mean());
  print("all", "end", all.end.mean());
  for (const NeesMean* nees : {&all.motion, &all.end}) {
    const std::optional<Nees> mean = nees->mean();
    ASSERT_TRUE(mean);
    EXPECT_GT(mean->mean, 0.5);
    EXPECT_LT(mean->mean, 2.0);
  }
}

}  // namespace
}  // namespace darkling
