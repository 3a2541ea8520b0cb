// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/text_file.h"
#include "support/synthetic_run.h"
#include "vo/limits.h"
#include "vo/memory_map.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

MonotonicTime stopped_clock() {
  return MonotonicTime();
}

constexpr double kMiB = 1024.0 * 1024.0;

bool is_stage(std::string_view word) {
  return word == "start" ||
         std::find(kStageNames.begin(), kStageNames.end(), word) != kStageNames.end();
}

// What is wrong between the table and what was claimed.
std::vector<std::string> faults(std::span<const BufferRow> rows,
                                std::span<const Arena::Entry> entries) {
  std::set<std::string> claimed;
  for (const Arena::Entry& entry : entries) claimed.insert(entry.name);
  std::set<std::string> told;
  std::vector<std::string> found;
  for (const BufferRow& row : rows) {
    const std::string name(row.name);
    if (!told.insert(name).second) found.push_back("two rows for " + name);
    if (!claimed.contains(name)) found.push_back("no buffer for the row " + name);
    if (row.holds.empty()) found.push_back("nothing held by " + name);
    for (const std::string_view stages : {row.writers, row.readers}) {
      for (const std::string_view stage : split(stages, ',')) {
        if (!is_stage(stage)) found.push_back("no stage " + std::string(stage) + " at " + name);
      }
    }
  }
  for (const std::string& name : claimed) {
    if (!told.contains(name)) found.push_back("no row for the buffer " + name);
  }
  return found;
}

TEST(MemoryMap, HasARowForEveryBufferAndABufferForEveryRow) {
  Arena arena = Arena::measuring();
  Odometry::claim_buffers({}, 320, 240, arena);
  EXPECT_THAT(faults(kBufferRows, arena.entries()), IsEmpty());
}

TEST(MemoryMapFaults, AreFoundBothWays) {
  const BufferRow rows[] = {{"a", "start", "track, select", "x"},
                            {"stale", "track", "track", "x"},
                            {"a", "track", "track", "x"},
                            {"b", "track, dream", "track", ""}};
  const Arena::Entry entries[] = {{"a", 1}, {"b", 1}, {"a", 1}, {"unnamed", 1}};
  EXPECT_THAT(faults(rows, entries),
              ElementsAre("no buffer for the row stale", "two rows for a", "nothing held by b",
                          "no stage dream at b", "no row for the buffer unnamed"));
}

TEST(MemoryMap, AddsUpToTheArenaThatTheOdometryClaims) {
  const test::SyntheticRun& run = test::synthetic_run("corridor,frames=1,width=320");
  for (const int width_px : {65, 97, 320}) {
    const auto odometry =
        Odometry::create({.width_px = width_px}, run.rig, KernelTable(), stopped_clock);
    ASSERT_TRUE(odometry);
    const RectifiedRig& rig = (*odometry)->rig();
    const MemoryMap map = map_memory({.width_px = width_px}, rig.width, rig.height);
    EXPECT_EQ(map.arena_bytes, (*odometry)->arena_bytes()) << width_px;
    EXPECT_EQ(std::accumulate(map.bytes.begin(), map.bytes.end(), map.gap_bytes), map.arena_bytes);
    EXPECT_LT(map.gap_bytes, 64 * kBufferRows.size() * 8);
  }
}

TEST(MemoryMap, KeepsItsBudgets) {
  const std::size_t small = map_memory({}, 320, 240).total_bytes();
  const std::size_t large = map_memory({}, 640, 480).total_bytes();
  RecordProperty("total_bytes_320x240", static_cast<int>(small));
  RecordProperty("total_bytes_640x480", static_cast<int>(large));
  EXPECT_LT(static_cast<double>(small), 8.0 * kMiB);
  EXPECT_LT(static_cast<double>(large), 24.0 * kMiB);
}

TEST(MemoryMap, KeepsTheBudgetInEveryCornerOfTheLimits) {
  for (const int points : {kMinPointsPerLevel, kMaxPointsPerLevel}) {
    for (const int width_px : {kMinWidth, 65, 333, 640, kMaxWidth}) {
      for (const int height_px : {kMinHeight, 240, 333, kMaxHeight}) {
        const MemoryMap map = map_memory({.points_per_level = points}, width_px, height_px);
        EXPECT_LT(map.total_bytes(), memory_budget_bytes(width_px, height_px))
            << width_px << "x" << height_px << ", " << points << " points";
      }
    }
  }
}

TEST(MemoryMap, CountsTheBuffersBehindARow) {
  const MemoryMap map = map_memory({}, 320, 240);
  EXPECT_EQ(map.counts[find_buffer_row("area map")], 2);
  EXPECT_EQ(map.counts[find_buffer_row("saliency")], 1);
  EXPECT_EQ(find_buffer_row("nothing of this name"), kBufferRows.size());
}

}  // namespace
}  // namespace darkling
