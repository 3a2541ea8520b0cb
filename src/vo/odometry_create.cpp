// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "vo/check_limits.h"
#include "vo/compare_intensity.h"
#include "vo/limits.h"
#include "vo/odometry_state.h"

namespace darkling {

namespace {

// The thumbnail, or why there is none: the rig makes no sense or a limit is exceeded.
Result<RectifiedRig> choose_thumbnail(const OdometryConfig& config, const StereoRig& rig) {
  if (Result<void> checked = check_rig(rig); !checked) return tl::unexpected(checked.error());
  const int width_px = config.width_px == 0 ? rig.left.width : config.width_px;
  const int height_px = thumbnail_height(rig.left, width_px);
  if (Result<void> limits = check_limits(config, width_px, height_px); !limits) {
    return tl::unexpected(limits.error());
  }
  return rectify_rig(rig, config.width_px);
}

}  // namespace

Odometry::Odometry(std::unique_ptr<State> state) : state_(std::move(state)) {}
// A refinement at work elsewhere uses the state.
Odometry::~Odometry() {
  if (state_ != nullptr && state_->is_refinement_due && state_->runner != nullptr) {
    (void)state_->runner->wait();
  }
}
const RectifiedRig& Odometry::rig() const {
  return state_->rig;
}
std::size_t Odometry::arena_bytes() const {
  return state_->arena.used_bytes();
}
std::int64_t Odometry::refinement_overruns() const {
  return state_->refinement_overruns;
}
std::size_t Odometry::state_bytes() {
  return sizeof(State);
}

Odometry::State::MapMemory Odometry::State::allocate_buffers(Arena& from) {
  const MapMemory maps = {allocate_area_map(rig, from), allocate_area_map(rig, from)};
  const int levels = pyramid_level_count(rig.width, rig.height);
  const int dense_level = stereo_level(rig.width, levels);
  left = allocate_pyramid(rig, {levels, levels, dense_level}, from);
  right = allocate_pyramid(rig, {dense_level + 1, 1, dense_level}, from);
  plane_scratch = allocate_plane_scratch(rig, from);
  matcher = allocate_stereo_matcher(rig.width >> dense_level, from);
  if (config.stereo == StereoMethod::kBlock) matcher.penalties = kBlockPenalties;
  disparities = allocate_disparities(rig.width, rig.height, levels, dense_level, from);
  selector = allocate_point_selector(rig, config.points_per_level, from);
  residuals = allocate_residuals(config.points_per_level, from);
  motions = allocate_motion_scratch(config.points_per_level, from);
  influences = allocate_influences(config.points_per_level, from);
  keyframe = allocate_template(levels, config.points_per_level, from);
  allocate_ring(levels, config.points_per_level, from, ring);
  if (config.refinement) {
    point_image = allocate_point_image(rig, from);
    allocate_window(rig, config, from, window);
    allocate_window_equations(config, from, equations);
  }
  return maps;
}

void Odometry::claim_buffers(const OdometryConfig& config, int width_px, int height_px,
                             Arena& arena) {
  RectifiedRig rig;
  rig.width = width_px;
  rig.height = height_px;
  (void)std::make_unique<State>(config, rig, KernelTable(), nullptr, nullptr, 0)
      ->allocate_buffers(arena);
}

// Buffers are claimed twice: first to measure them, then in an arena of exactly that size.
Result<std::unique_ptr<Odometry>> Odometry::create(const OdometryConfig& config,
                                                   const StereoRig& rig, const KernelTable& kernels,
                                                   ReadClock read_clock, RefinementRunner* runner) {
  const Result<RectifiedRig> rectified = choose_thumbnail(config, rig);
  if (!rectified) return tl::unexpected(rectified.error());
  Arena measuring = Arena::measuring();
  claim_buffers(config, rectified->width, rectified->height, measuring);

  const bool is_intensity = config.descriptor == Descriptor::kIntensity;
  auto state = std::make_unique<State>(config, *rectified,
                                       is_intensity ? compare_intensity(kernels) : kernels,
                                       read_clock, runner, measuring.used_bytes());
  State& s = *state;
  const State::MapMemory maps = s.allocate_buffers(s.arena);
  CHECK(s.arena.used_bytes() == s.arena.capacity_bytes(), "an arena is as large as was measured");
  s.arena.seal();

  const auto left_map = fill_area_map(rig.left, s.rig, s.rig.R_rawleft_left, maps.left);
  if (!left_map) return tl::unexpected(left_map.error());
  const auto right_map = fill_area_map(rig.right, s.rig, s.rig.R_rawright_right, maps.right);
  if (!right_map) return tl::unexpected(right_map.error());
  s.left_map = *left_map;
  s.right_map = *right_map;
  return std::unique_ptr<Odometry>(new Odometry(std::move(state)));
}

}  // namespace darkling
