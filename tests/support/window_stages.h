// SPDX-License-Identifier: Apache-2.0
// A window of keyframes with memory of its own, in a world whose truth is known.
#pragma once

#include <algorithm>
#include <vector>

#include "support/plane_world.h"
#include "support/random.h"
#include "support/vo_stages.h"
#include "vo/refine_window.h"

namespace darkling::test {

[[nodiscard]] Se3 motion(double x, double y, double z, double rx, double ry, double rz);

// All that a refinement may change, number by number: poses, and what is known of each point.
[[nodiscard]] std::vector<double> estimate_of(const Window& window);

// Root mean square distance, px, that a keyframe's points move by in its image when its pose turns
// from the one into the other.
[[nodiscard]] double image_motion_px(const Window& window, const WindowKeyframe& keyframe,
                                     const Se3& T_world_old, const Se3& T_world_new);

class WindowStages {
 public:
  struct Layout {
    int keyframes = 5;
    int points = 200;
    double disparity_sigma_px = 0.1;  // error of the disparities that the points start from
  };
  WindowStages(const RectifiedRig& rig, const Layout& layout);

  // Looks at the world from where a keyframe truly is, and adds it at `T_world_key`. Its points
  // have the disparities of the world, but for errors within √3 times `disparity_sigma_px`.
  void add(const PlaneWorld& world, const Se3& T_world_true, const Se3& T_world_key);
  void add(const PlaneWorld& world, const Se3& T_world_true) {
    add(world, T_world_true, T_world_true);
  }
  // At the identity before a painting, in which everything has one disparity.
  // @param level  (x, y) → grey level.
  template <class Level>
  void add_painting(const Level& level, float disparity_px) {
    paint(eye_.grey(), level);
    const ImageView<float> disparity = template_.disparity();
    for (int y = 0; y < rig_.height; ++y) std::fill_n(disparity.row(y), rig_.width, disparity_px);
    add_seen(Se3());
  }
  [[nodiscard]] Refinement refine() { return refine(kernels_); }
  [[nodiscard]] Refinement refine(const KernelTable& kernels) {
    return refine_window(kernels, eye_.pyramid()[0], equations_, window_);
  }
  void linearise() { linearise_window(kernels_, window_, equations_); }

  [[nodiscard]] const RectifiedRig& rig() const { return rig_; }
  [[nodiscard]] const KernelTable& kernels() const { return kernels_; }
  [[nodiscard]] EyeStages& eye() { return eye_; }  // of the newest keyframe
  [[nodiscard]] Window& window() { return window_; }
  [[nodiscard]] WindowEquations& equations() { return equations_; }

 private:
  // What was painted, with the disparities that are known of it.
  void add_seen(const Se3& T_world_key);

  RectifiedRig rig_;
  Layout layout_;
  KernelTable kernels_;
  Random random_{7};
  Arena arena_;
  EyeStages eye_;
  TemplateStages template_;
  Window window_;
  WindowEquations equations_;
};

// A window whose keyframes go forward, to the right and round a little, at their true poses, each
// refined when it was the newest but for the last.
class PlaneWindow : public WindowStages {
 public:
  explicit PlaneWindow(const PlaneWorld& world) : PlaneWindow(world, Layout()) {}
  PlaneWindow(const PlaneWorld& world, const Layout& layout);
  [[nodiscard]] static Se3 T_world_true(int keyframe);
};

}  // namespace darkling::test
