// SPDX-License-Identifier: Apache-2.0
// The materials of the scenes. Each shows structure at every scale from metres to millimetres, as
// natural surfaces do: fractal variation, stones, cracks; none is plain noise.
#pragma once

#include <cstdint>

#include "drivers/synthetic/texture.h"

namespace darkling::synthetic {

// Quarried or blasted rock: mottled, veined, cracked.
[[nodiscard]] Texture rock_surface(std::uint32_t seed);
// Loose stones of all sizes in dust.
[[nodiscard]] Texture gravel_surface(std::uint32_t seed);
// Sawn timber, grain along u.
[[nodiscard]] Texture timber_surface(std::uint32_t seed);
// A sky half covered: albedo 0 clear … 1 cloud.
[[nodiscard]] Texture cloud_surface(std::uint32_t seed);
// Painted plaster: smooth, with the roller's grain, scuffs and stains.
[[nodiscard]] Texture plaster_surface(std::uint32_t seed);
// Terrazzo tiles of 30 cm with joints.
[[nodiscard]] Texture tile_surface(std::uint32_t seed);
// Mineral-fibre ceiling boards of 60 cm with pin holes.
[[nodiscard]] Texture ceiling_surface(std::uint32_t seed);
// A notice board: sheets of paper with lines of print and pictures. One repetition is 1 m.
[[nodiscard]] Texture poster_surface(std::uint32_t seed);
// Even paint, slightly worn.
[[nodiscard]] Texture paint_surface(std::uint32_t seed);

}  // namespace darkling::synthetic
