// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "geometry/stereo_rig.h"
#include "io/trajectory.h"

namespace darkling {

// Whether images need no rectification: no distortion, both cameras alike and turned alike, the
// right one beside the left.
[[nodiscard]] bool is_rectified(const StereoRig& rig);

// A true trajectory, asked frame by frame.
class KnownPoses {
 public:
  // @param truth  nothing: no pose is known. Poses of the left camera are of use only where that is
  //               the rig's, as in a rectified one.
  KnownPoses(const std::optional<Trajectory>& truth, const StereoRig& rig);

  // T_world_body at just this frame; between two poses nothing is known.
  [[nodiscard]] std::optional<Se3> find(std::int64_t sequence, FrameTime stamp) const;

 private:
  PoseKey key_ = PoseKey::kRow;
  Se3 T_pose_body_;
  std::map<std::int64_t, Eigen::Affine3d> poses_;  // by row, or by stamp in ns
};

}  // namespace darkling
