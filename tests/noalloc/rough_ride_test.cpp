// SPDX-License-Identifier: Apache-2.0
#include "noalloc/rough_ride.h"

#include <cstdlib>
#include <cstring>

#include <gtest/gtest.h>

#include "platform/clocks.h"
#include "platform/heap_probe.h"
#include "support/kernel_cases.h"
#include "support/painted_stack.h"
#include "support/sanitized.h"
#include "vo/limits.h"

namespace darkling {
namespace {

using test::RideCounts;
using test::RoughRide;

// Few points, so that a build without optimisation is not all arithmetic.
std::unique_ptr<Odometry> make_odometry(const RoughRide& ride, const KernelTable& kernels) {
  auto odometry = Odometry::create({.width_px = RoughRide::kWidth_px, .points_per_level = 150},
                                   ride.rig(), kernels, read_monotonic_clock);
  EXPECT_TRUE(odometry) << odometry.error().message;
  return std::move(*odometry);
}

// Else the ride was not rough and proves nothing.
void expect_everything_happened(const RideCounts& counts) {
  EXPECT_EQ(counts.frames, 1000);
  EXPECT_EQ(counts.skipped, 12);
  EXPECT_GT(counts.valid, 500);
  EXPECT_GT(counts.lost, 48);
  EXPECT_GT(counts.keyframes, 20);
  EXPECT_GT(counts.refinements, 10);
  EXPECT_GE(counts.resets, 4);
  EXPECT_GE(counts.recoveries, 4);
}

class EachKernelTable : public ::testing::TestWithParam<KernelTable> {};

TEST_P(EachKernelTable, CallsNoHeapAndKeepsItsStackInAThousandFrames) {
  if (test::kIsSanitized) GTEST_SKIP() << "sanitizers have an allocator and frames of their own";
  const RoughRide ride;
  const auto odometry = make_odometry(ride, GetParam());
  RideCounts counts;
  std::int64_t heap_calls = -1;
  const std::size_t stack_bytes = test::measure_stack_bytes([&] {
    const std::int64_t before = count_heap_calls().value();
    counts = ride.drive(*odometry);
    heap_calls = count_heap_calls().value() - before;
  });
  EXPECT_EQ(heap_calls, 0);
  EXPECT_LE(stack_bytes, kMaxStackBytes);
  expect_everything_happened(counts);
  RecordProperty("heap_calls", static_cast<int>(heap_calls));
  RecordProperty("stack_bytes", static_cast<int>(stack_bytes));
  RecordProperty("lost", counts.lost);
  RecordProperty("keyframes", counts.keyframes);
  RecordProperty("resets", counts.resets);
  RecordProperty("recoveries", counts.recoveries);
}

INSTANTIATE_TEST_SUITE_P(RoughRide, EachKernelTable, ::testing::ValuesIn(test::available_tables()),
                         [](const auto& tested) { return std::string(tested.param.name); });

// Uses at least as much stack as it is told, and touches the far end.
[[gnu::noinline]] void use_stack(std::size_t bytes) {
  volatile char* const block = static_cast<volatile char*>(__builtin_alloca(bytes));
  block[0] = 1;
}

TEST(PaintedStack, ShowsWhatWasUsed) {
  if (test::kIsSanitized) GTEST_SKIP() << "sanitizers make frames of their own size";
  const std::size_t idle = test::measure_stack_bytes([] {});
  EXPECT_LT(idle, 2048u);
  for (const std::size_t bytes : {10'000u, 40'000u, 200'000u}) {
    const std::size_t used = test::measure_stack_bytes([bytes] { use_stack(bytes); });
    EXPECT_GE(used, bytes);
    EXPECT_LT(used, bytes + 2048);
  }
}

}  // namespace
}  // namespace darkling
