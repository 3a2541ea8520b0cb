// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/floor_plan.h"

#include <algorithm>
#include <cmath>

namespace darkling::synthetic {

namespace {

using Vec2f = Eigen::Vector2f;

Vec3f on_floor(const Vec2f& p) {
  return {p.x(), p.y(), 0.0f};
}

// A wall from `from` to `to`, the room on its right.
Wall make_wall(const Vec2f& from, const Vec2f& to) {
  Wall wall;
  wall.start = on_floor(from);
  wall.length_m = (to - from).norm();
  wall.along = on_floor(to - from) / wall.length_m;
  wall.inward = wall.along.cross(Vec3f::UnitZ());
  return wall;
}

// The way's straights meet at right angles: left along x, then along y, and so on.
std::vector<Vec2f> corridor_axis(const RoverPath& path) {
  const auto at = [&path](double s) -> Vec2f { return path.way(s).p.cast<float>(); };
  std::vector<Vec2f> axis = {at(path.first_m())};
  bool runs_along_x = true;
  for (double s : path.corners()) {
    const Vec2f before = axis.back();
    const Vec2f middle = at(std::min(s + 2.0, path.last_m()));
    // The straight keeps the coordinate it came with; the next one's is read off where it runs.
    axis.push_back(runs_along_x ? Vec2f(middle.x(), before.y()) : Vec2f(before.x(), middle.y()));
    runs_along_x = !runs_along_x;
  }
  const Vec2f last = axis.back();
  axis.push_back(runs_along_x ? Vec2f(last.x() + 4.0f, last.y())
                              : Vec2f(last.x(), last.y() + 4.0f));
  return axis;
}

}  // namespace

FloorPlan make_floor_plan(const RoverPath& path) {
  FloorPlan plan;
  plan.axis = corridor_axis(path);
  constexpr float kHalf = kCorridorHalfWidth_m;
  const std::size_t straights = plan.axis.size() - 1;
  for (std::size_t i = 0; i < straights; ++i) {
    const Vec2f& from = plan.axis[i];
    const Vec2f& to = plan.axis[i + 1];
    const Vec2f d = (to - from).normalized();
    const Vec2f left(-d.y(), d.x());
    const bool is_first = i == 0;
    const bool is_last = i + 1 == straights;
    // Even straights run along x and end in a left turn, odd ones along y and end in a right turn:
    // the inner wall ends short of the corner, the outer one beyond it.
    const float turn_in = is_first ? 0.0f : (i % 2 == 0 ? -1.0f : 1.0f);
    const float turn_out = is_last ? 0.0f : (i % 2 == 0 ? 1.0f : -1.0f);
    const Vec2f left_from = from + kHalf * (left + turn_in * d);
    const Vec2f left_to = to + kHalf * (left - turn_out * d);
    const Vec2f right_from = from - kHalf * (left + turn_in * d);
    const Vec2f right_to = to - kHalf * (left - turn_out * d);
    plan.walls.push_back(make_wall(left_from, left_to));
    plan.walls.push_back(make_wall(right_to, right_from));
    const Vec2f a = is_first ? from : Vec2f(from + kHalf * d);
    const Vec2f b = is_last ? to : Vec2f(to + kHalf * d);
    const Vec2f low = (a - kHalf * left).cwiseMin(b - kHalf * left).cwiseMin(a + kHalf * left);
    const Vec2f high = (a + kHalf * left).cwiseMax(b + kHalf * left).cwiseMax(b - kHalf * left);
    plan.rooms.push_back({low.x(), high.x(), low.y(), high.y()});
    if (is_first) plan.walls.push_back(make_wall(from - kHalf * left, from + kHalf * left));
    if (is_last) plan.walls.push_back(make_wall(to + kHalf * left, to - kHalf * left));
  }
  return plan;
}

bool FloorPlan::is_inside(float x, float y) const {
  return std::any_of(rooms.begin(), rooms.end(), [x, y](const Room& r) {
    return x > r.low_x && x < r.high_x && y > r.low_y && y < r.high_y;
  });
}

bool FloorPlan::is_open(const Vec3f& from, const Vec3f& to) const {
  constexpr int kSteps = 24;
  for (int i = 1; i < kSteps; ++i) {
    const Vec3f p = from + (to - from) * (static_cast<float>(i) / kSteps);
    if (!is_inside(p.x(), p.y())) return false;
  }
  return true;
}

}  // namespace darkling::synthetic
