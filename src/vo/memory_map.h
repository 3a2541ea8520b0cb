// SPDX-License-Identifier: Apache-2.0
// Every long-lived buffer of the odometry, in the order in which it is claimed. A test keeps rows
// and buffers the same; `darkling check --memory` prints them with their sizes.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "base/arena.h"
#include "vo/odometry_config.h"

namespace darkling {

// A row may stand for several buffers of one name: an eye, a level, a direction each.
struct BufferRow {
  std::string_view name;     // as given to the arena
  std::string_view writers;  // stages, by their names in vo/estimate.h; or "start", before all
  std::string_view readers;
  std::string_view holds;
};

inline constexpr std::array kBufferRows = std::to_array<BufferRow>({
    {"area weights", "start", "rectify", "each eye: shares of the source pixels in a box"},
    {"area map", "start", "rectify", "each eye: where each pixel is in the source"},
    {"pyramid grey", "rectify, pyramid", "planes", "left: every level; right: to the matched one"},
    {"bit-planes", "planes", "track, select", "left: every level; right: the thumbnail"},
    {"census codes", "planes", "stereo, select", "each eye: thumbnail and matched level"},
    {"plane rows", "planes", "planes", "scratch of a level's rows"},
    {"stereo paths", "stereo", "stereo", "path costs: 3 directions, 2 rows"},
    {"stereo path minima", "stereo", "stereo", "of each pixel's path costs"},
    {"stereo Hamming rows", "stereo", "stereo", "distances of codes, rows of the window"},
    {"stereo right codes", "stereo", "stereo", "a row, from its end"},
    {"stereo costs", "stereo", "stereo", "a row, summed over the window"},
    {"stereo path sums", "stereo", "stereo", "a row, summed over the paths"},
    {"stereo left winners", "stereo", "stereo", "a row: the left eye's lowest sums"},
    {"stereo right winners", "stereo", "stereo", "a row: the right eye's lowest sums"},
    {"disparities", "stereo", "select", "of the pair matched last: from its level up"},
    {"saliency", "select", "select", "scratch of a level"},
    {"strongest of columns", "select", "select", "scratch of a strip of rows"},
    {"columns of cells", "select", "select", "scratch of a level"},
    {"point candidates", "select", "select", "scratch of a level"},
    {"point residuals", "track", "track", "scratch of a level: three arrays"},
    {"residuals of a motion", "track", "track", "scratch: of the finest level"},
    {"motions of points", "track", "track", "scratch: which of two motions, a byte each"},
    {"point influences", "track", "track", "of the frame before, and scratch: seven arrays"},
    {"influence tiles", "track", "track", "scratch: sums of the points of a tile"},
    {"template points", "select", "track", "of the keyframe: every level, six arrays"},
    {"template patches", "select", "track", "of the keyframe: every level"},
    {"ring points", "select", "track", "each keyframe of the ring: every level, six arrays"},
    {"ring patches", "select", "track", "each keyframe of the ring: every level"},
    {"points of the window", "select", "select", "scratch: which point a pixel shows"},
    {"window points", "select, refine", "select, refine", "each keyframe: six arrays"},
    {"window patches", "select", "refine", "each keyframe"},
    {"window observations", "select, refine", "select, refine",
     "each keyframe: views by later ones"},
    {"window equations", "refine", "refine", "each keyframe: of its points' depths"},
    {"window normal equations", "refine", "refine", "of the keyframes' poses"},
});

// What the rows take for one thumbnail size.
struct MemoryMap {
  std::array<std::size_t, kBufferRows.size()> bytes = {};  // of each of kBufferRows
  std::array<int, kBufferRows.size()> counts = {};         // buffers behind the row
  std::size_t gap_bytes = 0;                               // from buffers to the next cache line
  std::size_t arena_bytes = 0;                             // the sum of the above: one block
  std::size_t state_bytes = 0;                             // the Odometry itself, beside the arena

  [[nodiscard]] std::size_t total_bytes() const { return arena_bytes + state_bytes; }
};

// The index in kBufferRows of a buffer; kBufferRows.size() when it has no row.
[[nodiscard]] std::size_t find_buffer_row(std::string_view name);

// @pre check_limits() finds nothing wrong.
[[nodiscard]] MemoryMap map_memory(const OdometryConfig& config, int width_px, int height_px);

}  // namespace darkling
