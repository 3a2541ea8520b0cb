// SPDX-License-Identifier: Apache-2.0
#include "app/bench/kernel_inputs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "platform/clocks.h"
#include "vo/area_map.h"
#include "vo/odometry.h"
#include "vo/refine_disparity.h"

namespace darkling {

namespace {

// References: what the kernels compute is the same whichever are used.
const KernelTable kTable;

struct MapMemory {
  AreaMapMemory left;
  AreaMapMemory right;
};

MapMemory allocate(KernelInputs& in, const StereoRig& rig, int points, Arena& arena) {
  const MapMemory maps = {allocate_area_map(in.rig, arena), allocate_area_map(in.rig, arena)};
  const int levels = pyramid_level_count(in.rig.width, in.rig.height);
  const int dense_level = stereo_level(in.rig.width, levels);
  in.raw_left = arena.allocate_image<std::uint8_t>(rig.left.width, rig.left.height, "raw image");
  in.left = allocate_pyramid(in.rig, {levels, levels, dense_level}, arena);
  in.right = allocate_pyramid(in.rig, {levels, levels, dense_level}, arena);
  in.plane_scratch = allocate_plane_scratch(in.rig, arena);
  in.matcher = allocate_stereo_matcher(in.rig.width >> dense_level, arena);
  in.disparities = allocate_disparities(in.rig.width, in.rig.height, levels, dense_level, arena);
  in.selector = allocate_point_selector(in.rig, points, arena);
  in.residuals = allocate_residuals(points, arena);
  in.keyframe = allocate_template(1, points, arena);
  return maps;
}

Result<void> fill_maps(KernelInputs& in, const StereoRig& rig, const MapMemory& maps) {
  const auto left_map = fill_area_map(rig.left, in.rig, in.rig.R_rawleft_left, maps.left);
  if (!left_map) return tl::unexpected(left_map.error());
  const auto right_map = fill_area_map(rig.right, in.rig, in.rig.R_rawright_right, maps.right);
  if (!right_map) return tl::unexpected(right_map.error());
  in.left_map = *left_map;
  in.right_map = *right_map;
  return {};
}

void prepare_images(KernelInputs& in, const StereoFrame& frame) {
  for (int y = 0; y < frame.left.height; ++y) {
    std::copy_n(frame.left.row(y), frame.left.width, in.raw_left.row(y));
  }
  kTable.remap_area(in.left_map, frame.left, in.left[0].grey);
  kTable.remap_area(in.right_map, frame.right, in.right[0].grey);
  for (FramePyramid* eye : {&in.left, &in.right}) {
    build_pyramid(kTable, *eye);
    for (PyramidLevel& level : *eye) compute_planes(kTable, in.plane_scratch, level);
  }
  const int dense = in.disparities.dense_level;
  (void)match_stereo(kTable, in.left[dense].codes, in.right[dense].codes, in.matcher,
                     in.disparities.levels[0]);
}

// Candidates where both kernels can be called, before and after the search.
void list_candidates(KernelInputs& in, std::span<PointSelector::Candidate> chosen) {
  const PyramidLevel& left = in.left[0];
  const PyramidLevel& right = in.right[0];
  const int reach = 1 << in.disparities.dense_level;
  in.search_count = 2 * reach + 1;
  for (const PointSelector::Candidate& c : chosen) {
    const int first = static_cast<int>(std::lround(c.disparity_px)) - reach;
    const int u = c.x - first;
    const bool has_patches = c.x >= kCodePatchRadius && c.x + kCodePatchRadius < in.rig.width &&
                             c.y >= kCodePatchRadius && c.y + kCodePatchRadius < in.rig.height &&
                             u - in.search_count + 1 >= kCodePatchRadius &&
                             u + kCodePatchRadius < in.rig.width;
    if (!has_patches) continue;
    in.code_candidates.push_back({left.codes.row(c.y) + c.x, right.codes.row(c.y) + u});
  }
  search_disparities(kTable, left, right, in.disparities.dense_level, chosen);
  for (const PointSelector::Candidate& c : chosen) {
    const int u_q12 = static_cast<int>((static_cast<float>(c.x) - c.disparity_px) * 4096.0f) + 1365;
    const int u = u_q12 >> 12;
    const bool has_patches = c.x >= 2 && c.x + 2 < in.rig.width && u >= 1 && u + 2 < in.rig.width &&
                             c.y >= 1 && c.y + 1 < in.rig.height;
    if (!has_patches) continue;
    in.plane_candidates.push_back({left.planes.row(c.y) + c.x * kPlaneCount,
                                   right.planes.row(c.y) + u * kPlaneCount, u_q12 & 4095});
  }
}

void build_template(KernelInputs& in) {
  const PyramidLevel& left = in.left[0];
  std::span<PointSelector::Candidate> chosen =
      select_points(kTable, left, in.disparities.at_level(0), in.selector);
  list_candidates(in, chosen);
  refine_disparities(kTable, left, in.right[0], chosen);
  build_template_level(kTable, drop_unknown(chosen), left, in.rig.baseline_m,
                       in.keyframe.levels[0]);
  in.warp = {.A = {1, 0, 0, 0, 1, 0, 0, 0, 1},
             .a = {0.01f, 0.0f, -0.02f},
             .focal_px = static_cast<float>(left.focal_px),
             .cx = static_cast<float>(left.cx),
             .cy = static_cast<float>(left.cy)};
  (void)kTable.sample_residuals(in.keyframe.levels[0].points, in.warp, left.planes, in.residuals);
}

}  // namespace

Result<std::unique_ptr<KernelInputs>> make_kernel_inputs(const StereoRig& rig,
                                                         const StereoFrame& frame,
                                                         const OdometryConfig& config) {
  const auto odometry = Odometry::create(config, rig, kTable, read_monotonic_clock);
  if (!odometry) return tl::unexpected(odometry.error());
  Arena measuring = Arena::measuring();
  KernelInputs measured((*odometry)->rig(), 0);
  (void)allocate(measured, rig, config.points_per_level, measuring);
  auto inputs = std::make_unique<KernelInputs>((*odometry)->rig(), measuring.used_bytes());
  const MapMemory maps = allocate(*inputs, rig, config.points_per_level, inputs->arena);
  if (auto filled = fill_maps(*inputs, rig, maps); !filled) {
    return tl::unexpected(filled.error());
  }
  prepare_images(*inputs, frame);
  build_template(*inputs);
  const bool has_points = inputs->keyframe.levels[0].points.count > 0 &&
                          !inputs->code_candidates.empty() && !inputs->plane_candidates.empty();
  if (!has_points) {
    return failure(ExitCode::kBadInput, "the first frame shows too little to find points in");
  }
  return inputs;
}

}  // namespace darkling
