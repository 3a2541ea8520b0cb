// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "drivers/synthetic/noise.h"
#include "drivers/synthetic/rover_path.h"

namespace darkling::synthetic {

inline constexpr float kCorridorHalfWidth_m = 1.3f;

// A stretch of wall from floor to ceiling.
struct Wall {
  Vec3f start = Vec3f::Zero();  // on the floor
  Vec3f along = Vec3f::UnitX();
  Vec3f inward = Vec3f::UnitY();  // along × up points into the room
  float length_m = 0.0f;

  [[nodiscard]] Vec3f at(float s_m, float z_m, float out_m) const {
    return start + s_m * along + z_m * Vec3f::UnitZ() + out_m * inward;
  }
};

struct Room {  // a rectangle of floor
  float low_x, high_x, low_y, high_y;
};

// The corridor along a square way: its walls and its floor in rectangles that do not overlap.
struct FloorPlan {
  std::vector<Eigen::Vector2f> axis;  // corner points of the centre line, both ends included
  std::vector<Wall> walls;
  std::vector<Room> rooms;

  [[nodiscard]] bool is_inside(float x, float y) const;
  // Whether a straight line over the floor from one place to the other meets no wall.
  [[nodiscard]] bool is_open(const Vec3f& from, const Vec3f& to) const;
};

[[nodiscard]] FloorPlan make_floor_plan(const RoverPath& path);

}  // namespace darkling::synthetic
