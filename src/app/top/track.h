// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/se3.h"

namespace darkling {

// Where a vehicle has been, in World, thinned so that it takes a bounded amount of memory.
// Thread: one.
class Track {
 public:
  struct Point {
    Vector3 position;  // m
    bool is_start;     // no way leads here from the point before
  };

  // @param reset_counter  of the pose; where it changes the track begins anew, and the jump is no
  //                       distance.
  void add(const Vector3& position, int reset_counter);

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  // The last position. @pre one was added.
  [[nodiscard]] const Vector3& here() const { return here_; }
  // Driven since the first position, m. Steps shorter than kLeastStep_m wait until they add up, so
  // that the noise of a vehicle at rest is no distance.
  [[nodiscard]] double distance_m() const { return distance_m_; }

  static constexpr double kLeastStep_m = 0.05;
  static constexpr std::size_t kMaxPoints = 4096;

 private:
  void thin_out();

  std::vector<Point> points_;
  Vector3 here_ = Vector3::Zero();
  std::optional<Vector3> counted_to_;  // distance_m_ leads here
  int reset_counter_ = 0;
  double distance_m_ = 0.0;
  double spacing_m_ = kLeastStep_m;  // of points; doubles whenever they are full
};

}  // namespace darkling
