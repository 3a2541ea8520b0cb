// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/result.h"
#include "geometry/stereo_rig.h"
#include "messages/rig_t.hpp"

namespace darkling {

// The rig as a record of a frame log; its texts are empty and left to the caller.
[[nodiscard]] rig_t to_rig_record(const StereoRig& rig);

// The same rig again, to the bit.
// @return kBadInput with what was found: another layout than this version's, an unknown camera
//         model, sizes out of 1…16384 px or that differ between the eyes, a transform that is none.
[[nodiscard]] Result<StereoRig> from_rig_record(const rig_t& record);

}  // namespace darkling
