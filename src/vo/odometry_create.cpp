// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "vo/limits.h"
#include "vo/odometry_state.h"

namespace darkling {

namespace {

Result<void> check_limits(const OdometryConfig& config, const RectifiedRig& rig) {
  const auto refuse = [](const char* what, int found, int low, int high) {
    return failure(ExitCode::kConfiguration, std::string(what) + " " + std::to_string(found) +
                                                 " is outside " + std::to_string(low) + "…" +
                                                 std::to_string(high));
  };
  if (rig.width < kMinWidth || rig.width > kMaxWidth) {
    return refuse("thumbnail width", rig.width, kMinWidth, kMaxWidth);
  }
  if (rig.height < kMinHeight || rig.height > kMaxHeight) {
    return refuse("thumbnail height", rig.height, kMinHeight, kMaxHeight);
  }
  if (config.points_per_level < kMinPointsPerLevel ||
      config.points_per_level > kMaxPointsPerLevel) {
    return refuse("points per level", config.points_per_level, kMinPointsPerLevel,
                  kMaxPointsPerLevel);
  }
  return {};
}

std::size_t arena_capacity(const RectifiedRig& rig) {
  const std::size_t pixels = std::size_t(rig.width + 64) * (rig.height + 2);
  return pixels * 64 + std::size_t(rig.width + 64) * kDisparities * 24 + (4u << 20);
}

}  // namespace

Odometry::Odometry(std::unique_ptr<State> state) : state_(std::move(state)) {}
Odometry::~Odometry() = default;
const RectifiedRig& Odometry::rig() const {
  return state_->rig;
}
std::size_t Odometry::arena_bytes() const {
  return state_->arena.used_bytes();
}

Result<std::unique_ptr<Odometry>> Odometry::create(const OdometryConfig& config,
                                                   const StereoRig& rig, const KernelTable& kernels,
                                                   ReadClock read_clock) {
  const Result<RectifiedRig> rectified = rectify_rig(rig, config.width_px);
  if (!rectified) return tl::unexpected(rectified.error());
  if (Result<void> limits = check_limits(config, *rectified); !limits) {
    return tl::unexpected(limits.error());
  }
  auto state =
      std::make_unique<State>(config, *rectified, kernels, read_clock, arena_capacity(*rectified));
  State& s = *state;
  const auto left_map = build_area_map(rig.left, s.rig, s.rig.R_rawleft_left, s.arena);
  if (!left_map) return tl::unexpected(left_map.error());
  const auto right_map = build_area_map(rig.right, s.rig, s.rig.R_rawright_right, s.arena);
  if (!right_map) return tl::unexpected(right_map.error());
  s.left_map = *left_map;
  s.right_map = *right_map;
  const int levels = pyramid_level_count(s.rig.width, s.rig.height);
  s.dense_level = stereo_level(s.rig.width, levels);
  s.left = allocate_pyramid(s.rig, {levels, levels, s.dense_level}, s.arena);
  s.right = allocate_pyramid(s.rig, {s.dense_level + 1, 1, s.dense_level}, s.arena);
  s.plane_scratch = allocate_plane_scratch(s.rig, s.arena);
  s.matcher =
      allocate_stereo_matcher(s.rig.width >> s.dense_level, s.rig.height >> s.dense_level, s.arena);
  s.selector = allocate_point_selector(s.rig, config.points_per_level, s.arena);
  s.residuals = allocate_residuals(config.points_per_level, s.arena);
  s.keyframe = allocate_template(levels, config.points_per_level, s.arena);
  s.arena.seal();
  return std::unique_ptr<Odometry>(new Odometry(std::move(state)));
}

}  // namespace darkling
