// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/top/draw_map.h"
#include "app/top/page.h"

namespace darkling {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Drives straight to `to` in steps of 10 cm.
void drive(Track& track, const Vector3& from, const Vector3& to, int reset_counter = 0) {
  const int steps = static_cast<int>((to - from).norm() / 0.1);
  for (int i = 0; i <= steps; ++i) track.add(from + (to - from) * i / steps, reset_counter);
}

struct Place {
  std::size_t row;
  std::size_t column;
};
std::optional<Place> place_of(char mark, const std::vector<std::string>& lines) {
  for (std::size_t row = 0; row < lines.size(); ++row) {
    const std::size_t column = lines[row].find(mark);
    if (column != std::string::npos) return Place{row, column};
  }
  return std::nullopt;
}

TEST(Track, AddsUpTheWayAndNotTheNoiseAtRest) {
  Track track;
  drive(track, {0, 0, 0}, {3, 0, 0});
  drive(track, {3, 0, 0}, {3, 4, 0});
  EXPECT_NEAR(track.distance_m(), 7.0, 1e-9);
  for (int i = 0; i < 1000; ++i) track.add({3.0, 4.0 + 0.02 * (i % 2), 0.0}, 0);
  EXPECT_NEAR(track.distance_m(), 7.0, 1e-9);
}

TEST(Track, TakesAJumpOfAResetForNoWay) {
  Track track;
  drive(track, {0, 0, 0}, {1, 0, 0}, 0);
  drive(track, {100, 0, 0}, {101, 0, 0}, 1);
  EXPECT_NEAR(track.distance_m(), 2.0, 1e-9);
  EXPECT_EQ(std::count_if(track.points().begin(), track.points().end(),
                          [](const Track::Point& p) { return p.is_start; }),
            2);
}

TEST(Track, StaysBoundedAndKeepsItsStartsAndEnd) {
  Track track;
  drive(track, {0, 0, 0}, {2000, 0, 0}, 0);
  drive(track, {0, 50, 0}, {2000, 50, 0}, 1);
  EXPECT_LT(track.points().size(), Track::kMaxPoints);
  EXPECT_GT(track.points().size(), Track::kMaxPoints / 4);
  EXPECT_NEAR(track.distance_m(), 4000.0, 0.1);
  EXPECT_EQ(track.points().front().position, Vector3::Zero());
  EXPECT_EQ(track.here(), Vector3(2000, 50, 0));
  EXPECT_EQ(std::count_if(track.points().begin(), track.points().end(),
                          [](const Track::Point& p) { return p.is_start; }),
            2);
}

TEST(DrawMap, ShowsForwardUpAndLeftToTheLeft) {
  Track track;
  drive(track, {0, 0, 0}, {4, 0, 0});
  drive(track, {4, 0, 0}, {4, 4, 0});
  const auto lines = draw_map(track, 22, 8, Glyphs::kAscii);
  ASSERT_EQ(lines.size(), 8u);
  const auto start = place_of('o', lines);
  const auto end = place_of('@', lines);
  ASSERT_TRUE(start && end);
  EXPECT_LT(end->row, start->row);
  EXPECT_LT(end->column, start->column);
  EXPECT_EQ(lines[end->row].size(), start->column + 1);  // the corner is right above the start
}

TEST(DrawMap, KeepsItsShapeAndStatesItsScale) {
  Track track;
  drive(track, {0, 0, 0}, {0, -30, 0});
  const auto lines = draw_map(track, 32, 5, Glyphs::kAscii);
  // 30 m fit into 30 columns: one each, and the bar is the largest of 1, 2, 5 in a third of them.
  EXPECT_EQ(lines.back(), "|--------| 10 m, x up");
  EXPECT_EQ(lines[2].find_first_not_of(' '), 1u);
  EXPECT_EQ(lines[2].size(), 32u);
}

TEST(DrawMap, FitsItsFrameWithEitherGlyphs) {
  for (const Glyphs glyphs : {Glyphs::kAscii, Glyphs::kUnicode}) {
    Track track;
    for (int i = 0; i < 500; ++i) {
      track.add({i * std::sin(i * 0.1), i * std::cos(i * 0.07), 0.0}, i / 100);
      const auto lines = draw_map(track, 33, 20, glyphs);
      ASSERT_EQ(lines.size(), 20u);
      for (const std::string& line : lines) ASSERT_LE(columns_of(line), 33);
    }
  }
}

TEST(DrawMap, SaysWhenThereIsNoTrack) {
  EXPECT_THAT(draw_map(Track(), 20, 3, Glyphs::kUnicode), ElementsAre("no track yet", "", ""));
}

TEST(DrawMap, DrawsBrailleWhereTheTerminalCan) {
  Track track;
  drive(track, {0, 0, 0}, {10, 0, 0});
  const auto lines = draw_map(track, 20, 8, Glyphs::kUnicode);
  EXPECT_THAT(lines[3], HasSubstr("⡇"));
  EXPECT_THAT(lines.back(), StartsWith("├"));
}

}  // namespace
}  // namespace darkling
