// SPDX-License-Identifier: Apache-2.0
// What the benchmark of kernels rests on: that its tables are whole, that work is counted, and that
// its timer tells a long task from a short one.
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "app/bench/counting_kernels.h"
#include "app/bench/interleave.h"
#include "app/bench/kernel_workloads.h"
#include "app/bench/play_frames.h"
#include "kernels/arithmetic_peak.h"

namespace darkling {
namespace {

TEST(KernelWorkloads, CallEveryKernelOnceEachInTheOrderOfItsName) {
  const auto workloads = KernelWorkloads::create_rendered(96, 72, 100);
  ASSERT_TRUE(workloads) << workloads.error().message;
  ASSERT_EQ(workloads->all().size(), std::size_t{kKernelCount});
  const KernelTable counting = counting_kernels(KernelTable());
  for (int k = 0; k < kKernelCount; ++k) {
    const KernelWorkload& workload = workloads->all()[k];
    EXPECT_EQ(workload.kernel, static_cast<Kernel>(k));
    (void)take_counted_work();
    workload.run(counting);
    const FrameWork work = take_counted_work();
    for (int other = 0; other < kKernelCount; ++other) {
      EXPECT_EQ(work[other].units, other == k ? workload.units : 0.0) << kKernelNames[k].name;
    }
    EXPECT_NEAR(work[k].total.bytes, workload.working_set_bytes(), 1e-6) << kKernelNames[k].name;
  }
}

TEST(KernelWorkloads, RefuseAnImageThatCannotBe) {
  EXPECT_EQ(KernelWorkloads::create_rendered(10, 10, 100).error().code, ExitCode::kUsage);
}

TEST(CountingKernels, ForgetWhatWasTaken) {
  std::vector<std::uint8_t> pixels(64);
  const KernelTable counting = counting_kernels(KernelTable());
  counting.halve({pixels.data(), 4, 4, 4}, {pixels.data() + 32, 2, 2, 2});
  const auto halve = static_cast<std::size_t>(Kernel::kHalve);
  EXPECT_EQ(take_counted_work()[halve].units, 4.0);
  EXPECT_EQ(take_counted_work()[halve].units, 0.0);
}

TEST(MeasureInterleaved, TellsALongTaskFromAShortOneAndCallsBoth) {
  volatile int sink = 0;
  const auto spin = [&sink](int turns) {
    for (int i = 0; i < turns; ++i) sink = i;
  };
  const std::vector<std::function<void()>> tasks = {[&] { spin(100); }, [&] { spin(10000); }};
  int rounds_shown = 0;
  const auto timings =
      measure_interleaved(tasks, {.rounds = 5, .show = [&](int, int) { ++rounds_shown; }});
  ASSERT_EQ(timings.size(), 2u);
  EXPECT_GT(timings[1].median_ns, 5.0 * timings[0].median_ns);
  EXPECT_EQ(rounds_shown, 5);
}

TEST(MedianFrames, TakeEachTimeByItself) {
  const auto play = [](double frame_us, double rectify_us) {
    PlayedFrame frame = {.is_keyframe = true, .frame_us = frame_us};
    frame.stage_us[static_cast<std::size_t>(Stage::kRectify)] = rectify_us;
    return Play{.width = 96, .height = 72, .frames = {frame}};
  };
  const auto frames = median_frames(std::vector<Play>{play(9, 1), play(5, 4), play(6, 2)});
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_TRUE(frames[0].is_keyframe);
  EXPECT_EQ(frames[0].frame_us, 6.0);
  EXPECT_EQ(frames[0].stage_us[static_cast<std::size_t>(Stage::kRectify)], 2.0);
  EXPECT_EQ(frames[0].rest_us(), 4.0);
  EXPECT_EQ(mean_frame_us(frames, true), 6.0);
  EXPECT_EQ(mean_frame_us(frames, false), 0.0);  // there is none
}

// A round more must change the result: else the compiler has done the arithmetic beforehand.
TEST(ArithmeticPeak, DoesEveryRound) {
  for (const char* name : {"ref", "sse41"}) {
    const ArithmeticPeak peak = arithmetic_peak(name);
    std::uint8_t out[2][kMaxVectorBytes] = {};
    peak.bytes(10, out[0]);
    peak.bytes(11, out[1]);
    EXPECT_NE(out[0][0], out[1][0]) << name;
  }
}

}  // namespace
}  // namespace darkling
