// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "io/config.h"
#include "vo/limits.h"

namespace darkling {

namespace {

using C = OdometryConfig;

// name, unit, least, most, field, what it is, whether 0 is allowed besides, limits' names.
constexpr std::array kKeys = std::to_array<ConfigKey>({
    {"width_px", "px", kMinWidth, kMaxWidth, &C::width_px,
     "Width of the thumbnail that is tracked; its height follows. 0 is the source's width.",
     /*may_be_zero=*/true, "kMinWidth, kMaxWidth"},
    {"points_per_level", "", kMinPointsPerLevel, kMaxPointsPerLevel, &C::points_per_level,
     "Most points the template holds on the finest level of the pyramid, and half as many on each "
     "coarser one; bounds the time of a frame.",
     /*may_be_zero=*/false, "kMinPointsPerLevel, kMaxPointsPerLevel"},
});

}  // namespace

std::span<const ConfigKey> config_keys() {
  return kKeys;
}

}  // namespace darkling
