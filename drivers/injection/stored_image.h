// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/image_size.h"
#include "base/image_view.h"
#include "drivers/injection/pixels.h"

namespace darkling {

// An image that is kept for a later frame; its memory is claimed once.
class StoredImage {
 public:
  void claim(ImageSize size) {
    size_ = size;
    pixels_.resize(static_cast<std::size_t>(size.width) * size.height);
  }
  // @pre `image` has the size that was claimed.
  void store(const ImageView<const std::uint8_t>& image) { copy_pixels(image, view()); }
  [[nodiscard]] ImageView<std::uint8_t> view() {
    return {pixels_.data(), size_.width, size_.height, size_.width};
  }

 private:
  ImageSize size_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace darkling
