// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <type_traits>
#include <utility>

#include "io/config.h"
#include "vo/limits.h"

namespace darkling {

namespace {

using C = OdometryConfig;

template <auto Field>
constexpr WordField one_of(std::span<const std::string_view> words) {
  using Enumeration = std::remove_cvref_t<decltype(std::declval<C>().*Field)>;
  return {
      words,
      [](const C& config) { return static_cast<std::size_t>(config.*Field); },
      [](C& config, std::size_t word) { config.*Field = static_cast<Enumeration>(word); },
  };
}

// In the order of their enumerations.
constexpr std::array kDescriptorWords = std::to_array<std::string_view>({"bitplanes", "intensity"});
constexpr std::array kStereoWords = std::to_array<std::string_view>({"semi_global", "block"});

// name, unit, least, most, field, what it is, whether 0 is allowed besides, limits' names.
constexpr std::array kKeys = std::to_array<ConfigKey>({
    {"width_px", "px", kMinWidth, kMaxWidth, &C::width_px,
     "Width of the thumbnail that is tracked; its height follows. 0 is the source's width.",
     /*may_be_zero=*/true, "kMinWidth, kMaxWidth"},
    {"points_per_level", "", kMinPointsPerLevel, kMaxPointsPerLevel, &C::points_per_level,
     "Most points the template holds on the finest level of the pyramid, and half as many on each "
     "coarser one; bounds the time of a frame.",
     /*may_be_zero=*/false, "kMinPointsPerLevel, kMaxPointsPerLevel"},
    {"descriptor", "", 0, 0, one_of<&C::descriptor>(kDescriptorWords),
     "What is compared between images: bitplanes are the signs of differences of brightness, which "
     "no exposure changes; intensity is brightness itself and is there to compare with."},
    {"stereo", "", 0, 0, one_of<&C::stereo>(kStereoWords),
     "How a keyframe's disparities are found: semi_global lets neighbours agree, block takes the "
     "least cost of each window by itself and is there to compare with."},
    {"refinement", "", 0, 0, &C::refinement,
     "Whether the last keyframes and their points are refined together, and new keyframes start "
     "from "
     "the depths found so."},
    {"window_keyframes", "", kMinWindowKeyframes, kMaxWindowKeyframes, &C::window_keyframes,
     "How many keyframes are refined together.",
     /*may_be_zero=*/false, "kMinWindowKeyframes, kMaxWindowKeyframes"},
    {"window_points", "", kMinWindowPoints, kMaxWindowPoints, &C::window_points,
     "Most points of each keyframe that are refined.",
     /*may_be_zero=*/false, "kMinWindowPoints, kMaxWindowPoints"},
});

}  // namespace

std::span<const ConfigKey> config_keys() {
  return kKeys;
}

}  // namespace darkling
