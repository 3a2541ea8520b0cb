// SPDX-License-Identifier: Apache-2.0
// JPEG images of smooth texture, as OpenCV writes them.
#pragma once

#include <cstdint>
#include <vector>

namespace darkling::test {

struct JpegKind {
  int quality = 75;  // 0 to 100
  bool is_colour = false;
  bool is_progressive = false;
  bool has_best_tables = false;  // made for the image, in place of the usual ones
  int seed = 0;                  // of the texture
};

[[nodiscard]] std::vector<std::uint8_t> jpeg_image(int width, int height,
                                                   const JpegKind& kind = {});

// Without those segments whose marker is FF `marker`.
[[nodiscard]] std::vector<std::uint8_t> without_segments(const std::vector<std::uint8_t>& jpeg,
                                                         int marker);

}  // namespace darkling::test
