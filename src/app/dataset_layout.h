// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

// How the files of a recording lie in its folder.
enum class DatasetLayout {
  kEuroc,  // mav0/camN/{data/<ns>.png,data.csv,sensor.yaml}, groundtruth.tum (T_world_body)
  kKitti,  // image_N/<number>.png, calib.txt, times.txt, poses.txt (T_world_left)
};

}  // namespace darkling
