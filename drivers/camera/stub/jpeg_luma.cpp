// SPDX-License-Identifier: Apache-2.0
// Where there is no libjpeg.
#include "drivers/camera/jpeg_luma.h"

#include "base/check.h"

namespace darkling {

struct JpegLuma::State {};

bool can_decode_jpeg() {
  return false;
}

JpegLuma::JpegLuma(int /*most_width_px*/) {
  CHECK(false, "this build has no libjpeg");
}
JpegLuma::~JpegLuma() = default;
JpegLuma::JpegLuma(JpegLuma&&) noexcept = default;
JpegLuma& JpegLuma::operator=(JpegLuma&&) noexcept = default;

bool JpegLuma::decode(std::span<const std::uint8_t> /*jpeg*/,
                      const ImageView<std::uint8_t>& /*grey*/) {
  return false;
}

}  // namespace darkling
