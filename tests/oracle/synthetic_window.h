// SPDX-License-Identifier: Apache-2.0
// The window as it comes about on a rendered drive: rectified, matched, tracked and carried on as
// the odometry does, a keyframe every few frames.
#pragma once

#include <span>
#include <string>

#include "support/synthetic_run.h"
#include "support/vo_stages.h"
#include "vo/area_map.h"
#include "vo/carry_depth.h"
#include "vo/refine_disparity.h"
#include "vo/refine_window.h"

namespace darkling::test {

class SyntheticWindow {
 public:
  // @param stride  frames from one keyframe to the next.
  SyntheticWindow(const SyntheticRun& run, const RectifiedRig& rig, int stride)
      : run_(run),
        rig_(rig),
        levels_(pyramid_level_count(rig.width, rig.height)),
        arena_(16u << 20),
        left_(rig, levels_),
        right_(rig, levels_),
        template_(rig, levels_, config_.points_per_level),
        matcher_(allocate_stereo_matcher(rig.width, arena_)),
        image_(allocate_point_image(rig, arena_)) {
    left_map_ = fill_area_map(run.rig.left, rig, rig.R_rawleft_left, allocate_area_map(rig, arena_))
                    .value();
    right_map_ =
        fill_area_map(run.rig.right, rig, rig.R_rawright_right, allocate_area_map(rig, arena_))
            .value();
    allocate_window(rig, config_, arena_, window_);
    allocate_window_equations(config_, arena_, equations_);
    for (int k = 0; k < config_.window_keyframes; ++k) {
      if (k >= kMinWindowKeyframes) (void)refine();
      add(k * stride);
    }
  }

  [[nodiscard]] Refinement refine() {
    return refine_window(kernels_, left_.pyramid()[0], equations_, window_);
  }
  [[nodiscard]] Refinement descend() { return descend_window(kernels_, equations_, window_); }
  [[nodiscard]] double cost() {
    linearise_window(kernels_, window_, equations_);
    return equations_.cost;
  }
  [[nodiscard]] Window& window() { return window_; }

 private:
  [[nodiscard]] Se3 T_world_true(int frame) const {
    return run_.T_world_body[static_cast<std::size_t>(frame)] * rig_.T_body_left;
  }

  void add(int frame) {
    const StereoFrame pair = run_.frames[static_cast<std::size_t>(frame)].at(frame);
    kernels_.remap_area(left_map_, pair.left, left_.grey());
    kernels_.remap_area(right_map_, pair.right, right_.grey());
    left_.prepare(kernels_);
    right_.prepare(kernels_);
    const Se3 T_world_key = window_.count == 0 ? T_world_true(frame) : track(frame);
    (void)match_stereo(kernels_, left_.codes(), right_.codes(), matcher_, template_.disparity());
    for (int level = levels_ - 1; level >= 0; --level) choose_points(level, T_world_key);
    previous_frame_ = frame;
  }

  // From the true motion as a guess.
  [[nodiscard]] Se3 track(int frame) {
    const Se3 guess = T_world_true(frame).inverse() * T_world_true(previous_frame_);
    const Alignment alignment = align_frame(kernels_, template_.keyframe(), left_.pyramid(),
                                            {&guess, 1}, template_.residuals());
    return window_.newest().T_world_key * alignment.T_current_key.inverse();
  }

  void choose_points(int level, const Se3& T_world_key) {
    TemplateLevel& out = template_.keyframe().levels[level];
    const PyramidLevel& planes = left_.pyramid()[level];
    std::span<PointSelector::Candidate> chosen =
        select_points(kernels_, planes, template_.disparities_at(level),
                      template_.selector().for_at_most(out.capacity));
    if (level == 0) {
      refine_disparities(kernels_, planes, right_.pyramid()[0], chosen);
      chosen = drop_unknown(chosen);
    }
    build_template_level(kernels_, chosen, planes, rig_.baseline_m, out);
    if (level > 0) return;
    (void)carry_depths(window_, T_world_key, planes, chosen, image_, out.points);
    add_keyframe(T_world_key, out.points, chosen, window_);
  }

  const SyntheticRun& run_;
  RectifiedRig rig_;
  OdometryConfig config_;
  KernelTable kernels_;
  int levels_;
  Arena arena_;
  EyeStages left_;
  EyeStages right_;
  TemplateStages template_;
  StereoMatcher matcher_;
  PointImage image_;
  AreaMap left_map_;
  AreaMap right_map_;
  Window window_;
  WindowEquations equations_;
  int previous_frame_ = 0;
};

}  // namespace darkling::test
