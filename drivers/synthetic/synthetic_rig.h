// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drivers/synthetic/synthetic_spec.h"
#include "geometry/stereo_rig.h"

namespace darkling {

// The cameras of the rover that drives through the scenes, as they are: 85° across, 12 cm apart,
// 0.67 m above the ground, 8° down. Body is 0.25 m above the ground.
// @pre check_synthetic() accepted the specification.
[[nodiscard]] StereoRig make_synthetic_rig(const SyntheticSpec& spec);

}  // namespace darkling
