// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "geometry/camera.h"

namespace darkling::test {

struct CameraCase {
  std::string name;
  Camera camera;
  // Rays up to this angle from the axis are inside the domain of the model, rad.
  double domain_rad = 0.0;
  // Whether the whole image is.
  bool covers_image = true;
};

inline void PrintTo(const CameraCase& camera_case, std::ostream* out) {
  *out << camera_case.name;
}

// Every camera model, with lenses from mild to those that fold back inside the image.
[[nodiscard]] std::vector<CameraCase> camera_cases();

}  // namespace darkling::test
