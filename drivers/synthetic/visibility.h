// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "drivers/synthetic/mesh.h"

namespace darkling::synthetic {

// An ideal pinhole camera in the scene.
struct PinholeView {
  int width = 0;  // px
  int height = 0;
  double focal_px = 1.0;
  double cx = 0.0;
  double cy = 0.0;
  Eigen::Matrix3d R_scene_camera = Eigen::Matrix3d::Identity();  // optical axes
  Eigen::Vector3d p_scene = Eigen::Vector3d::Zero();             // where it is
};

// Which triangle each pixel centre sees; -1 for none.
struct VisibilityBuffer {
  int width = 0;
  int height = 0;
  std::vector<std::int32_t> triangle;
  std::vector<float> inverse_depth;  // 1/m; 0 for none

  void resize(int w, int h);
};

// Corners as a view sees them; scratch of one thread.
struct ProjectedVertex {
  Vec3f p_camera;      // m
  std::int32_t x = 0;  // px / 256
  std::int32_t y = 0;
  bool is_in_front = false;
};

// Finds what is seen. Corners are rounded to 1/256 px and the edges then compared in integers, so
// neighbouring facets leave no gap; where a facet's surface lies is not touched by that.
// Facets nearer than 5 cm are left out.
void find_visible(const Mesh& mesh, const PinholeView& view, VisibilityBuffer& buffer,
                  std::vector<ProjectedVertex>& scratch);

}  // namespace darkling::synthetic
