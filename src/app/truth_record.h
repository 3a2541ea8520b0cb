// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "io/trajectory.h"
#include "messages/truth_t.hpp"

namespace darkling {

// A true trajectory as a record of a frame log and back, every number to the bit.
[[nodiscard]] truth_t to_truth_record(const Trajectory& truth);
// @return nothing for a frame or a key of a later version, and for poses that are no rigid motions.
[[nodiscard]] std::optional<Trajectory> from_truth_record(const truth_t& record);

}  // namespace darkling
