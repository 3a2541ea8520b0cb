// SPDX-License-Identifier: Apache-2.0
#include "drivers/camera/eye_layout.h"

namespace darkling {

ImageExtent wanted_extent(const CameraConfig& config, PixelFormat format, ImageExtent eye) {
  const int cell = format == PixelFormat::kBayer ? 2 : 1;
  const int eyes_across = config.layout == EyeLayout::kSideBySide ? 2 : 1;
  const int eyes_down = config.layout == EyeLayout::kTopBottom ? 2 : 1;
  return {.width = config.width_px > 0 ? config.width_px : eye.width * eyes_across * cell,
          .height = config.height_px > 0 ? config.height_px : eye.height * eyes_down * cell};
}

ImageExtent eye_extent(EyeLayout layout, ImageExtent grey) {
  switch (layout) {
    case EyeLayout::kTwoDevices:
      return grey;
    case EyeLayout::kSideBySide:
      if (grey.width % 2 == 0) return {.width = grey.width / 2, .height = grey.height};
      break;
    case EyeLayout::kTopBottom:
      if (grey.height % 2 == 0) return {.width = grey.width, .height = grey.height / 2};
      break;
  }
  return {};
}

std::array<ImageView<const std::uint8_t>, 2> split_eyes(
    EyeLayout layout, const ImageView<const std::uint8_t>& image) {
  const ImageExtent eye = eye_extent(layout, {.width = image.width, .height = image.height});
  const bool is_side_by_side = layout == EyeLayout::kSideBySide;
  const std::uint8_t* right = is_side_by_side ? image.data + eye.width : image.row(eye.height);
  return {{{image.data, eye.width, eye.height, image.stride},
           {right, eye.width, eye.height, image.stride}}};
}

}  // namespace darkling
