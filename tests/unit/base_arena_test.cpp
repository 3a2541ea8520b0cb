// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include <gtest/gtest.h>

#include "base/arena.h"

namespace darkling {
namespace {

bool is_on_cache_line(const void* p) {
  return reinterpret_cast<std::uintptr_t>(p) % 64 == 0;
}

struct Wide {
  double value = 7.0;
  char tail = 'x';
};

TEST(Arena, StartsEveryArrayOnACacheLine) {
  Arena arena(4096);
  EXPECT_TRUE(is_on_cache_line(arena.allocate<char>(1, "one byte").data()));
  EXPECT_TRUE(is_on_cache_line(arena.allocate<double>(3, "three doubles").data()));
  EXPECT_TRUE(is_on_cache_line(arena.allocate<Wide>(5, "five structs").data()));
}

TEST(Arena, HandsOutElementsWithTheirInitialValues) {
  Arena arena(4096);
  for (const Wide& wide : arena.allocate<Wide>(5, "structs")) EXPECT_EQ(wide.value, 7.0);
  for (const int number : arena.allocate<int>(100, "numbers")) EXPECT_EQ(number, 0);
}

TEST(Arena, NeverOverlapsWhatItHandsOut) {
  Arena arena(4096);
  const auto a = arena.allocate<std::uint8_t>(100, "a");
  const auto b = arena.allocate<std::uint8_t>(100, "b");
  EXPECT_GE(b.data(), a.data() + a.size());
}

TEST(Arena, StartsEveryImageRowOnACacheLine) {
  Arena arena(65536);
  const auto bytes = arena.allocate_image<std::uint8_t>(65, 3, "bytes");
  const auto floats = arena.allocate_image<float>(17, 3, "floats");
  EXPECT_EQ(bytes.stride, 128);
  EXPECT_EQ(floats.stride, 32);
  for (int y = 0; y < 3; ++y) {
    EXPECT_TRUE(is_on_cache_line(bytes.row(y)));
    EXPECT_TRUE(is_on_cache_line(floats.row(y)));
  }
}

template <class Pixel>
std::ptrdiff_t readable_bytes_behind_the_last_row() {
  Arena arena(65536);
  const auto image = arena.allocate_image<Pixel>(64, 2, "image");
  const auto next = arena.allocate<char>(1, "next");
  return next.data() - reinterpret_cast<char*>(image.row(1) + 64);
}

TEST(Arena, LeavesACacheLineReadableBehindTheLastRow) {
  struct SixBytes {
    std::uint16_t values[3] = {};
  };
  EXPECT_GE(readable_bytes_behind_the_last_row<char>(), 64);
  EXPECT_GE(readable_bytes_behind_the_last_row<float>(), 64);
  EXPECT_GE(readable_bytes_behind_the_last_row<SixBytes>(), 64);
}

TEST(Arena, ListsWhatItHandedOutInOrder) {
  Arena arena(4096);
  static_cast<void>(arena.allocate<int>(10, "first"));
  static_cast<void>(arena.allocate<char>(3, "second"));
  ASSERT_EQ(arena.entries().size(), 2U);
  EXPECT_STREQ(arena.entries()[0].name, "first");
  EXPECT_EQ(arena.entries()[0].bytes, 40U);
  EXPECT_STREQ(arena.entries()[1].name, "second");
  EXPECT_EQ(arena.entries()[1].bytes, 3U);
}

TEST(Arena, CountsUsedBytesWithTheGapsForAlignment) {
  Arena arena(4096);
  static_cast<void>(arena.allocate<char>(1, "first"));
  static_cast<void>(arena.allocate<char>(1, "second"));
  EXPECT_EQ(arena.used_bytes(), 65U);
}

TEST(Arena, CanBeFilledToTheLastByte) {
  Arena arena(256);
  EXPECT_EQ(arena.allocate<char>(256, "all").size(), 256U);
  EXPECT_EQ(arena.used_bytes(), arena.capacity_bytes());
}

struct CountsItsConstructions {
  static inline int constructed = 0;
  double value;
  CountsItsConstructions() : value(1.0) { ++constructed; }
};

// Sizes that do not end on cache lines, so that the gaps count.
void make_requests(Arena& arena) {
  static_cast<void>(arena.allocate<char>(3, "few"));
  static_cast<void>(arena.allocate<CountsItsConstructions>(5, "structs"));
  static_cast<void>(arena.allocate_image<float>(17, 3, "floats"));
  static_cast<void>(arena.allocate<char>(1, "one"));
}

TEST(Arena, OnlyMeasuresWithoutConstructingAnything) {
  Arena measuring = Arena::measuring();
  CountsItsConstructions::constructed = 0;
  EXPECT_TRUE(measuring.allocate<CountsItsConstructions>(5, "structs").empty());
  EXPECT_EQ(CountsItsConstructions::constructed, 0);
  const auto image = measuring.allocate_image<float>(17, 3, "floats");
  EXPECT_EQ(image.data, nullptr);
  EXPECT_TRUE(image.has_size(17, 3));
  EXPECT_EQ(image.stride, 32);
}

TEST(Arena, MeasuresWhatTheSameRequestsFillToTheLastByte) {
  Arena measuring = Arena::measuring();
  make_requests(measuring);
  Arena exact(measuring.used_bytes());
  make_requests(exact);
  EXPECT_EQ(exact.used_bytes(), exact.capacity_bytes());
  ASSERT_EQ(exact.entries().size(), measuring.entries().size());
  for (std::size_t i = 0; i < exact.entries().size(); ++i) {
    EXPECT_STREQ(exact.entries()[i].name, measuring.entries()[i].name);
    EXPECT_EQ(exact.entries()[i].bytes, measuring.entries()[i].bytes);
  }
  Arena short_of_a_byte(measuring.used_bytes() - 1);
  EXPECT_DEATH(make_requests(short_of_a_byte), "arena is full");
}

TEST(ArenaDeath, AbortsWhenASealedArenaIsAskedForMemory) {
  Arena arena(4096);
  arena.seal();
  EXPECT_DEATH(static_cast<void>(arena.allocate<int>(1, "late")), "sealed arena");
}

TEST(ArenaDeath, AbortsWhenItIsFull) {
  Arena arena(256);
  EXPECT_DEATH(static_cast<void>(arena.allocate<char>(257, "too much")), "arena is full");
}

TEST(ArenaDeath, AbortsWhenTheGapForAlignmentLeavesNoRoom) {
  Arena arena(65);
  static_cast<void>(arena.allocate<char>(1, "first"));
  EXPECT_DEATH(static_cast<void>(arena.allocate<char>(2, "second")), "arena is full");
}

TEST(ArenaDeath, AbortsOnASizeThatWrapsRound) {
  Arena arena(256);
  EXPECT_DEATH(static_cast<void>(arena.allocate<double>(SIZE_MAX / 4, "absurd")), "wraps round");
}

TEST(ArenaDeath, AbortsOnAnImageWithoutPixels) {
  Arena arena(256);
  EXPECT_DEATH(static_cast<void>(arena.allocate_image<char>(0, 5, "empty")), "has pixels");
}

}  // namespace
}  // namespace darkling
