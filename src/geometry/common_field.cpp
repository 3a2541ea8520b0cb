// SPDX-License-Identifier: Apache-2.0
#include "geometry/common_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace darkling {

namespace {

using Vector2 = Eigen::Vector2d;

// Rays flatter than this (89° from the axis) are beyond every rectangle asked for.
constexpr double kMinRayZ = 0.0175;
constexpr double kOffsetPenalty = 0.01;
constexpr double kTolerance = 1e-4;  // of the half height: 0.03 px in 300

// Sizes below count in half heights: x is divided by the aspect, so that a rectangle of the wanted
// shape around c is the set of points at a distance (greatest of |dx|, |dy|) up to its half height.
struct SeenRegion {
  TurnedCamera turned;
  double aspect = 1.0;
  std::vector<Vector2> border;
};

double distance(const Vector2& a, const Vector2& b) {
  return (a - b).lpNorm<Eigen::Infinity>();
}

// The ray of the border pixel or, where the lens model ends before it, of the last pixel on the way
// there from the principal point.
std::optional<Vector3> outermost_ray(const Camera& camera, const Vector2& pixel) {
  if (const auto ray = unproject(camera, pixel)) return ray;
  const Vector2 principal(camera.cx, camera.cy);
  double inside = 0.0;
  double outside = 1.0;
  for (int halving = 0; halving < 20; ++halving) {
    const double middle = 0.5 * (inside + outside);
    const bool is_seen = unproject(camera, principal + middle * (pixel - principal)).has_value();
    (is_seen ? inside : outside) = middle;
  }
  return unproject(camera, principal + inside * (pixel - principal));
}

// The outline of the image, traced through the lens, about one point a pixel.
SeenRegion trace_region(const TurnedCamera& turned, double aspect) {
  const Camera& camera = turned.camera;
  SeenRegion region{.turned = turned, .aspect = aspect, .border = {}};
  region.border.reserve(2 * (camera.width + camera.height) + 4);
  const double right = camera.width - 0.5;
  const double bottom = camera.height - 0.5;
  const auto add = [&](double u, double v) {
    const auto ray = outermost_ray(camera, {u, v});
    if (!ray) return;
    const Vector3 turned_ray = turned.R_raw_rectified.transpose() * *ray;
    if (turned_ray.z() < kMinRayZ) return;
    region.border.emplace_back(turned_ray.x() / turned_ray.z() / aspect,
                               turned_ray.y() / turned_ray.z());
  };
  for (int x = 0; x <= camera.width; ++x) {
    add(x - 0.5, -0.5);
    add(x - 0.5, bottom);
  }
  for (int y = 0; y <= camera.height; ++y) {
    add(-0.5, y - 0.5);
    add(right, y - 0.5);
  }
  return region;
}

bool sees(const SeenRegion& region, const Vector2& c) {
  const Camera& camera = region.turned.camera;
  const Vector3 ray =
      (region.turned.R_raw_rectified * Vector3(c.x() * region.aspect, c.y(), 1.0)).normalized();
  if (camera.distortion != Distortion::kEquidistant && ray.z() <= 0.0) return false;
  const Vector2 pixel = project(camera, ray);
  if (!(pixel.x() > -0.5 && pixel.x() < camera.width - 0.5)) return false;
  if (!(pixel.y() > -0.5 && pixel.y() < camera.height - 0.5)) return false;
  const auto back = unproject(camera, pixel);  // another ray, or none, beyond the domain
  return back && (*back - ray).norm() < 1e-6;
}

// Half height of the largest rectangle around `c`; below zero, the distance to the region.
double room(const SeenRegion& region, const Vector2& c) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector2& point : region.border) nearest = std::min(nearest, distance(c, point));
  return sees(region, c) ? nearest : -nearest;
}

// A square of centres still to be searched.
struct Cell {
  Vector2 centre;
  double half = 0.0;
  double value = 0.0;  // of its centre
  double bound = 0.0;  // no point of the cell is worth more
};

}  // namespace

std::optional<FieldOfView> largest_common_field(const TurnedCamera& left, const TurnedCamera& right,
                                                double aspect, double max_half_width) {
  const SeenRegion regions[] = {trace_region(left, aspect), trace_region(right, aspect)};
  const double max_half_height = max_half_width / aspect;
  const auto half_height = [&](const Vector2& c) {
    return std::min({room(regions[0], c), room(regions[1], c), max_half_height});
  };
  const auto make_cell = [&](const Vector2& c, double half) {
    // Both terms of the value change by no more than the way gone, along the diagonal at most.
    const double reach = std::sqrt(2.0) * half;
    const double size = half_height(c);
    return Cell{.centre = c,
                .half = half,
                .value = size - kOffsetPenalty * c.norm(),
                .bound = std::min(size + half, max_half_height) -
                         kOffsetPenalty * std::max(c.norm() - reach, 0.0)};
  };
  const auto is_worse = [](const Cell& a, const Cell& b) { return a.bound < b.bound; };

  // Branch and bound: split the most promising square until none can be better than the best found.
  std::vector<Cell> heap = {make_cell(Vector2::Zero(), 1.0 / kMinRayZ)};
  Cell best = heap.front();
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), is_worse);
    const Cell cell = heap.back();
    heap.pop_back();
    if (cell.bound <= best.value + kTolerance * std::max(best.value, 0.01)) break;
    const double half = 0.5 * cell.half;
    for (const Vector2& way : {Vector2(-1, -1), Vector2(1, -1), Vector2(-1, 1), Vector2(1, 1)}) {
      const Cell part = make_cell(cell.centre + half * way, half);
      if (part.value > best.value) best = part;
      heap.push_back(part);
      std::push_heap(heap.begin(), heap.end(), is_worse);
    }
  }
  const double size = half_height(best.centre);
  if (!(size > 0.0)) return std::nullopt;
  // A hair less, so that rounding leaves no corner outside.
  return FieldOfView{.centre = {best.centre.x() * aspect, best.centre.y()},
                     .half_height = size * (1.0 - 1e-6),
                     .aspect = aspect};
}

}  // namespace darkling
