// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/rover_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/synthetic/noise.h"

namespace darkling::synthetic {

namespace {

constexpr double kStep_m = 0.002;
constexpr double kStep_s = 0.001;
constexpr double kMargin_s = 0.2;       // time before the first and after the last frame
constexpr double kCorner_m = 1.9;       // way over which a corner is turned
constexpr double kFirstCorner_m = 3.4;  // its middle, from the start
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

// The stops: every ten seconds one of a second, and one of a moment.
struct Stop {
  double from_s, until_s;
};
constexpr double kStopCycle_s = 10.0;
constexpr Stop kStops[] = {{3.9, 4.7}, {7.6, 7.8}};
constexpr double kBrake_s = 0.5;

double smooth(double x) {  // 0…1 with no acceleration at either end
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}
double smooth_rate(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return 30.0 * t * t * (1.0 - t) * (1.0 - t);
}

double unit(std::uint64_t seed, std::uint64_t n) {
  return static_cast<double>(mix64(seed ^ mix64(n)) >> 11) * 0x1p-53;
}

// Piecewise linear look-up in a table of values `step` apart.
template <class T>
T interpolate(const std::vector<T>& table, double position) {
  const double x = std::clamp(position, 0.0, static_cast<double>(table.size() - 1) - 1e-9);
  const auto i = static_cast<std::size_t>(x);
  const double t = x - static_cast<double>(i);
  return table[i] * (1.0 - t) + table[i + 1] * t;
}

}  // namespace

RoverPath::RoverPath(const WayShape& shape, const Drive& drive, std::uint64_t seed)
    : shape_(shape), speed_mps_(drive.speed_mps) {
  for (std::uint64_t i = 0; i < 4; ++i) phase_[i] = kTwoPi * unit(seed, 100 + i);
  drive_along(drive);
  // The curve that has this heading at every arc length; kStep_m is short enough for the middle
  // rule to be exact to a micrometre.
  const int count = static_cast<int>((last_m() - first_m()) / kStep_m) + 2;
  curve_.reserve(count);
  Eigen::Vector2d p = Eigen::Vector2d::Zero();
  for (int i = 0; i < count; ++i) {
    curve_.push_back(p);
    const double a = heading(first_m() + (i + 0.5) * kStep_m);
    p += kStep_m * Eigen::Vector2d(std::cos(a), std::sin(a));
  }
  const Eigen::Vector2d start = interpolate(curve_, shape_.lead_m / kStep_m);
  for (Eigen::Vector2d& q : curve_) q -= start;
  place_bumps(drive.bump_scale, seed);
}

RoverPath::Corner RoverPath::corner(double s_m) const {
  const double pitch_m = shape_.straight_m + kCorner_m;
  const double k = std::floor((s_m - kFirstCorner_m) / pitch_m + 0.5);
  const double along = (s_m - kFirstCorner_m - k * pitch_m) / kCorner_m + 0.5;  // 0…1 through it
  const bool is_left = std::fmod(std::abs(k), 2.0) < 0.5;
  const double turned = is_left ? smooth(along) : 1.0 - smooth(along);
  return {0.5 * std::numbers::pi * turned, smooth_rate(along) / 1.875};
}

double RoverPath::axis(double s_m) const {
  if (shape_.is_square) return corner(s_m).heading_rad;
  return shape_.swing_deg * kDegree *
         (0.8 * std::sin(kTwoPi * s_m / 7.0 + phase_[0]) +
          0.2 * std::sin(kTwoPi * s_m / 11.3 + phase_[1]));
}

double RoverPath::heading(double s_m) const {
  return axis(s_m) + shape_.correction_deg * kDegree *
                         (0.7 * std::sin(kTwoPi * s_m / 2.7 + phase_[2]) +
                          0.3 * std::sin(kTwoPi * s_m / 1.6 + phase_[3]));
}

std::vector<double> RoverPath::corners() const {
  std::vector<double> at;
  if (!shape_.is_square) return at;
  const double pitch_m = shape_.straight_m + kCorner_m;
  for (double s = kFirstCorner_m; s < last_m(); s += pitch_m) at.push_back(s);
  return at;
}

double RoverPath::speed(double t_s, double s_m) const {
  double v = speed_mps_ * (1.0 + 0.15 * std::sin(kTwoPi * t_s / 3.1 + phase_[1]));
  if (shape_.is_square) v *= 1.0 - 0.5 * corner(s_m).turning;
  const double in_cycle = t_s - kStopCycle_s * std::floor(t_s / kStopCycle_s);
  for (const Stop& stop : kStops) {
    const double going = in_cycle < stop.from_s ? (stop.from_s - in_cycle) / kBrake_s
                                                : (in_cycle - stop.until_s) / kBrake_s;
    v *= smooth(going);
  }
  return v;
}

void RoverPath::drive_along(const Drive& drive) {
  const int count = static_cast<int>((drive.duration_s + 2.0 * kMargin_s) / kStep_s) + 2;
  distances_.reserve(count);
  double s = -kMargin_s * speed_mps_;
  for (int i = 0; i < count; ++i) {
    distances_.push_back(s);
    s += kStep_s * speed((i + 0.5) * kStep_s - kMargin_s, s);
  }
  const double start = interpolate(distances_, kMargin_s / kStep_s);
  for (double& d : distances_) d -= start;
  end_m_ = distances_.back();
}

double RoverPath::distance(double t_s) const {
  return interpolate(distances_, (t_s + kMargin_s) / kStep_s);
}

// A bump about every 0.7 m, at most 1.6° and 9 mm.
void RoverPath::place_bumps(double scale, std::uint64_t seed) {
  double next_m = 0.3;
  for (std::size_t i = 0; i < distances_.size(); ++i) {
    if (distances_[i] < next_m) continue;
    const std::uint64_t n = 1000 + 8 * bumps_.size();
    const auto swing = [&](std::uint64_t k) { return scale * (2.0 * unit(seed, n + k) - 1.0); };
    bumps_.push_back({.t_s = static_cast<double>(i) * kStep_s - kMargin_s,
                      .pitch_rad = 1.6 * kDegree * swing(0),
                      .roll_rad = 1.6 * kDegree * swing(1),
                      .heave_m = 0.009 * swing(2)});
    next_m += 0.35 + 0.7 * unit(seed, n + 3);
  }
}

WayPoint RoverPath::way(double s_m) const {
  return {.p = interpolate(curve_, (s_m - first_m()) / kStep_m),
          .heading_rad = heading(s_m),
          .axis_rad = axis(s_m)};
}

Se3 RoverPath::T_scene_body(double t_s) const {
  const WayPoint at = way(distance(t_s));
  const Eigen::Vector2d forward(std::cos(at.heading_rad), std::sin(at.heading_rad));
  const Eigen::Vector2d left(-forward.y(), forward.x());
  double z = kBodyHeight_m;
  double pitch = 0.0;  // nose down is positive: a rotation about y (left)
  double roll = 0.0;
  if (ground_) {
    const auto height = [&](const Eigen::Vector2d& p) { return ground_(p.x(), p.y()); };
    const double front = height(at.p + 0.3 * forward);
    const double back = height(at.p - 0.3 * forward);
    const double port = height(at.p + 0.25 * left);
    const double starboard = height(at.p - 0.25 * left);
    z += 0.25 * (front + back + port + starboard);
    pitch = -std::atan((front - back) / 0.6);
    roll = std::atan((port - starboard) / 0.5);
  }
  for (const Bump& bump : bumps_) {
    const double dt = t_s - bump.t_s;
    if (dt <= 0.0 || dt > 1.5) continue;
    // A damped swing at 2.6 Hz that sets in smoothly and peaks near 1.
    const double swing =
        1.6 * (1.0 - std::exp(-dt / 0.05)) * std::exp(-dt / 0.22) * std::sin(kTwoPi * 2.6 * dt);
    pitch += bump.pitch_rad * swing;
    roll += bump.roll_rad * swing;
    z += bump.heave_m * swing;
  }
  const Eigen::Quaterniond q =
      so3_exp({0, 0, at.heading_rad}) * so3_exp({0, pitch, 0}) * so3_exp({roll, 0, 0});
  return Se3(q, {at.p.x(), at.p.y(), z});
}

}  // namespace darkling::synthetic
