// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/image_size.h"
#include "base/image_view.h"
#include "base/result.h"
#include "drivers/dataset/dataset_rows.h"

namespace darkling {

// Whether `bytes` are a PNG or JPEG file from its first byte to its end mark, with PNG check sums
// that are right. Decoders give half an image for half a file.
[[nodiscard]] bool is_complete_image_file(std::span<const std::uint8_t> bytes);

// An image file in memory that is kept from one read to the next: same sizes, no allocation.
class ImageBuffer {
 public:
  ImageBuffer();
  ~ImageBuffer();
  ImageBuffer(ImageBuffer&&) noexcept;
  ImageBuffer& operator=(ImageBuffer&&) noexcept;

  // Reads and decodes `path` to 8-bit grey: colour by luminance, 16 bits by their upper 8.
  // @return whether there is an image now; a file that is absent, truncated or corrupt is none.
  [[nodiscard]] bool read(const std::string& path);

  [[nodiscard]] ImageView<const std::uint8_t> image() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The size of the images of a recording: that of the first pair that can be read.
// @return kBadInput when the eyes of that pair differ, kNoInput when no pair can be read.
[[nodiscard]] Result<ImageSize> first_pair_size(const std::vector<DatasetRow>& rows);

// "752x480".
[[nodiscard]] std::string to_text(const ImageSize& size);

}  // namespace darkling
