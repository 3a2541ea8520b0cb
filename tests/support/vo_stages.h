// SPDX-License-Identifier: Apache-2.0
// The stages of the pipeline with memory of their own, to be tried one at a time.
#pragma once

#include "support/plane_world.h"
#include "vo/align.h"
#include "vo/frame_pyramid.h"
#include "vo/keyframe_template.h"
#include "vo/match_stereo.h"
#include "vo/odometry_state.h"

namespace darkling::test {

// One eye's pyramid, planes and codes, filled as the odometry fills them.
class EyeStages {
 public:
  // @param matched_level  the level that stereo matches; it has codes, as level 0 has.
  EyeStages(const RectifiedRig& rig, int level_count, int matched_level = 0)
      : arena_(std::size_t(rig.width + 64) * (rig.height + 2) * 40 + (1u << 20)),
        pyramid_(allocate_pyramid(rig, {level_count, level_count, matched_level}, arena_)),
        scratch_(allocate_plane_scratch(rig, arena_)) {}

  // To be painted before prepare().
  [[nodiscard]] ImageView<std::uint8_t> grey() { return pyramid_[0].grey; }
  void prepare(const KernelTable& kernels) {
    build_pyramid(kernels, pyramid_);
    for (PyramidLevel& level : pyramid_) compute_planes(kernels, scratch_, level);
  }
  [[nodiscard]] const FramePyramid& pyramid() const { return pyramid_; }
  [[nodiscard]] ImageView<const std::uint8_t> codes(int level = 0) const {
    return pyramid_[level].codes;
  }

 private:
  Arena arena_;
  FramePyramid pyramid_;
  std::span<std::uint8_t> scratch_;
};

// A keyframe's template of an eye, from disparities that the test knows.
class TemplateStages {
 public:
  TemplateStages(const RectifiedRig& rig, int level_count, int points_per_level)
      : rig_(rig),
        arena_(std::size_t(rig.width + 64) * (rig.height + 2) * 8 +
               std::size_t(points_per_level) * (32 + 64 * level_count) + (1u << 20)),
        disparities_(allocate_disparities(rig.width, rig.height, level_count, 0, arena_)),
        selector_(allocate_point_selector(rig, points_per_level, arena_)),
        keyframe_(allocate_template(level_count, points_per_level, arena_)),
        residuals_(allocate_residuals(points_per_level, arena_)) {}

  // Of level 0; what is known of the other levels follows from it.
  [[nodiscard]] ImageView<float> disparity() { return disparities_.levels[0]; }
  [[nodiscard]] DisparityPyramid::At disparities_at(int level) {
    reduce_disparities(disparities_);
    return disparities_.at_level(level);
  }
  [[nodiscard]] const PointSelector& selector() const { return selector_; }
  [[nodiscard]] const PointResiduals& residuals() const { return residuals_; }
  [[nodiscard]] KeyframeTemplate& keyframe() { return keyframe_; }

  // The true disparities of a world seen from `T_world_camera`.
  void know_disparities(const PlaneWorld& world, const Se3& T_world_camera) {
    for (int y = 0; y < rig_.height; ++y) {
      for (int x = 0; x < rig_.width; ++x) {
        disparity().at(x, y) = static_cast<float>(rig_.focal_px * rig_.baseline_m /
                                                  world.depth_m(rig_, T_world_camera, x, y));
      }
    }
  }
  void build(const KernelTable& kernels, const FramePyramid& pyramid) {
    for (int l = 0; l < static_cast<int>(pyramid.size()); ++l) {
      const auto chosen = select_points(kernels, pyramid[l], disparities_at(l),
                                        selector_.for_at_most(keyframe_.levels[l].capacity));
      build_template_level(kernels, chosen, pyramid[l], rig_.baseline_m, keyframe_.levels[l]);
    }
  }

 private:
  RectifiedRig rig_;
  Arena arena_;
  DisparityPyramid disparities_;
  PointSelector selector_;
  KeyframeTemplate keyframe_;
  PointResiduals residuals_;
};

}  // namespace darkling::test
