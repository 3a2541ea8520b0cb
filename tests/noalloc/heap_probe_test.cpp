// SPDX-License-Identifier: Apache-2.0
// The probe must see every way to the heap: a count of zero means something only then.
#include "platform/heap_probe.h"

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <ostream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <malloc.h>
#include <opencv2/core.hpp>

#include "support/sanitized.h"

namespace darkling {
namespace {

// Makes the compiler believe that somebody looks at the block, so that it stays.
void* keep(void* block) {
  asm volatile("" : "+r"(block) : : "memory");
  return block;
}

struct WayToTheHeap {
  const char* name;
  void (*go)();  // there and back
};

void PrintTo(const WayToTheHeap& way, std::ostream* out) {
  *out << way.name;
}

class EachWayToTheHeap : public ::testing::TestWithParam<WayToTheHeap> {
 protected:
  void SetUp() override {
    if (test::kIsSanitized) GTEST_SKIP() << "no probe under sanitizers";
  }
};

TEST_P(EachWayToTheHeap, IsSeenThereAndBack) {
  const std::int64_t before = count_heap_calls().value();
  GetParam().go();
  EXPECT_GE(count_heap_calls().value() - before, 2);
}

void posix_aligned() {
  void* block = nullptr;
  ASSERT_EQ(posix_memalign(&block, 64, 100), 0);
  std::free(keep(block));
}

constexpr WayToTheHeap kWays[] = {
    {"Malloc", [] { std::free(keep(std::malloc(100))); }},
    {"Calloc", [] { std::free(keep(std::calloc(10, 10))); }},
    {"Realloc", [] { std::free(keep(std::realloc(nullptr, 100))); }},
    {"Reallocarray", [] { std::free(keep(reallocarray(nullptr, 10, 10))); }},
    {"Memalign", [] { std::free(keep(memalign(64, 100))); }},
    {"AlignedAlloc", [] { std::free(keep(std::aligned_alloc(64, 128))); }},
    {"PosixMemalign", posix_aligned},
    {"Valloc", [] { std::free(keep(valloc(100))); }},
    {"Pvalloc", [] { std::free(keep(pvalloc(100))); }},
    {"New", [] { ::operator delete(keep(::operator new(100))); }},
    {"NewAligned",
     [] {
       constexpr std::align_val_t kLine{64};
       ::operator delete(keep(::operator new(100, kLine)), kLine);
     }},
    // Inside shared libraries: libstdc++ grows the string, OpenCV allocates the matrix.
    {"StringOfLibstdcxx", [] { keep(std::string().append(1000, 'x').data()); }},
    {"MatrixOfOpenCv", [] { keep(cv::Mat(100, 100, CV_8U).data); }},
};

INSTANTIATE_TEST_SUITE_P(HeapProbe, EachWayToTheHeap, ::testing::ValuesIn(kWays),
                         [](const auto& tested) { return tested.param.name; });

TEST(HeapProbe, CountsNothingWhenNothingHappens) {
  if (test::kIsSanitized) GTEST_SKIP() << "no probe under sanitizers";
  const std::int64_t before = count_heap_calls().value();
  int numbers[100] = {};
  keep(numbers);
  EXPECT_EQ(count_heap_calls().value(), before);
}

TEST(HeapProbe, CountsEachThreadForItself) {
  if (test::kIsSanitized) GTEST_SKIP() << "no probe under sanitizers";
  std::int64_t others = 0;
  std::thread other([&others] {
    const std::int64_t before = count_heap_calls().value();
    for (int i = 0; i < 1000; ++i) std::free(keep(std::malloc(100)));
    others = count_heap_calls().value() - before;
  });
  const std::int64_t before = count_heap_calls().value();
  other.join();
  EXPECT_LT(count_heap_calls().value() - before, 1000);
  EXPECT_GE(others, 2000);
}

TEST(HeapProbe, RefusesWhatTheAllocatorRefuses) {
  if (test::kIsSanitized) GTEST_SKIP() << "no probe under sanitizers";
  void* block = nullptr;
  EXPECT_EQ(posix_memalign(&block, 24, 100), EINVAL);
  const std::size_t half = std::size_t{1} << (8 * sizeof(std::size_t) - 1);
  // Called through a pointer, or the compiler sees that it is absurd.
  void* (*volatile reallocate)(void*, std::size_t, std::size_t) = reallocarray;
  EXPECT_EQ(reallocate(nullptr, half, 2), nullptr);
}

}  // namespace
}  // namespace darkling
