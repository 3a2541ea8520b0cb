// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "geometry/se3.h"

namespace darkling::synthetic {

// A place on the way, at some arc length.
struct WayPoint {
  Eigen::Vector2d p = Eigen::Vector2d::Zero();  // scene, m
  double heading_rad = 0.0;                     // where the rover points
  double axis_rad = 0.0;  // where the way leads: the heading without the driver's small corrections
};

// How a way bends. `square`: long straights and right-angled corners, left and right in turn.
// Otherwise: winding, as round obstacles.
struct WayShape {
  bool is_square = false;
  double straight_m = 4.2;      // between corners
  double swing_deg = 24.0;      // winding: how far the heading swings
  double correction_deg = 7.0;  // the driver's small corrections
  double lead_m = 4.0;          // way before the start and …
  double beyond_m = 16.0;       // … beyond the end, to build the scene along
};

// The motion of a rover: a way over the ground, a speed along it with stops, bumps that pitch,
// roll and heave it. Smooth, and exact at any time: what is returned here is the truth.
class RoverPath {
 public:
  struct Drive {
    double duration_s = 10.0;
    double speed_mps = 0.9;
    double bump_scale = 1.0;
  };
  RoverPath(const WayShape& shape, const Drive& drive, std::uint64_t seed);

  // The height of the ground under the rover; level at 0 when not set. Must be smooth over 0.3 m.
  void set_ground(std::function<double(double x_m, double y_m)> ground) {
    ground_ = std::move(ground);
  }

  // Body (x forward, y left, z up; 0.25 m above the ground) in the scene.
  // @param t_s  since the first frame; a little before it and after the last one is fine.
  [[nodiscard]] Se3 T_scene_body(double t_s) const;

  [[nodiscard]] WayPoint way(double s_m) const;
  [[nodiscard]] double first_m() const { return -shape_.lead_m; }
  [[nodiscard]] double last_m() const { return end_m_ + shape_.beyond_m; }
  // Arc length driven when the recording ends.
  [[nodiscard]] double end_m() const { return end_m_; }
  // Arc lengths in the middle of the corners of a square way.
  [[nodiscard]] std::vector<double> corners() const;

  static constexpr double kBodyHeight_m = 0.25;

 private:
  struct Bump {
    double t_s;
    double pitch_rad, roll_rad, heave_m;
  };
  [[nodiscard]] double heading(double s_m) const;
  [[nodiscard]] double axis(double s_m) const;
  // The nearest corner of a square way, left and right in turn.
  struct Corner {
    double heading_rad;
    double turning;  // 0 on the straight … 1 in the middle of the corner
  };
  [[nodiscard]] Corner corner(double s_m) const;
  [[nodiscard]] double speed(double t_s, double s_m) const;
  [[nodiscard]] double distance(double t_s) const;
  void drive_along(const Drive& drive);
  void place_bumps(double scale, std::uint64_t seed);

  WayShape shape_;
  double speed_mps_;
  double phase_[4] = {};
  double end_m_ = 0.0;
  std::vector<Eigen::Vector2d> curve_;  // every kStep_m from first_m()
  std::vector<double> distances_;       // every kStep_s from -kMargin_s
  std::vector<Bump> bumps_;
  std::function<double(double, double)> ground_;
};

}  // namespace darkling::synthetic
