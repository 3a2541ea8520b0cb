// SPDX-License-Identifier: Apache-2.0
// The luma of JPEG images, as cameras send them one after the other for Motion JPEG.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/image_view.h"

namespace darkling {

// Whether this build can: libjpeg was there.
[[nodiscard]] bool can_decode_jpeg();

// Decodes any number of images, in memory of its own that it claims when it is made and never adds
// to: libjpeg would ask the heap for every image.
// Thread: one at a time.
class JpegLuma {
 public:
  // @param most_width_px  of an image. @pre can_decode_jpeg().
  explicit JpegLuma(int most_width_px);
  ~JpegLuma();
  JpegLuma(JpegLuma&&) noexcept;
  JpegLuma& operator=(JpegLuma&&) noexcept;

  // @param jpeg  may be anything at all. Bytes behind the image are passed over, and so are those
  //              between its segments, which many cameras leave there. Huffman tables that are
  //              missing, as of Motion JPEG they may, are the usual ones.
  // @param grey  of the size that the image has to have; holds anything after a failure.
  // @return false when it is no whole image in one scan of that size.
  // Exactness: integers only, the same on every machine.
  [[nodiscard]] bool decode(std::span<const std::uint8_t> jpeg,
                            const ImageView<std::uint8_t>& grey);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace darkling
