// SPDX-License-Identifier: Apache-2.0
// How the pixel formats of cameras lie in memory, V4L2's codes for them, and their way to 8-bit
// grey.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/camera_config.h"
#include "base/image_view.h"

namespace darkling {

struct ImageExtent {
  int width = 0;   // px
  int height = 0;  // px
  friend bool operator==(const ImageExtent&, const ImageExtent&) = default;
};

// How a device's images lie in its buffers.
struct ImageFormat {
  PixelFormat format = PixelFormat::kAny;
  std::uint32_t fourcc = 0;
  ImageExtent extent = {};  // of the device's image, both eyes of a shared one together
  std::ptrdiff_t stride_bytes = 0;
  std::size_t bytes = 0;  // that a buffer must have filled
};

// Every format but kAny, in the order in which they are tried.
inline constexpr std::array<PixelFormat, 12> kPixelFormats = {
    PixelFormat::kGrey,  PixelFormat::kY10,  PixelFormat::kY10P, PixelFormat::kY12,
    PixelFormat::kY16,   PixelFormat::kYuyv, PixelFormat::kUyvy, PixelFormat::kNv12,
    PixelFormat::kBayer, PixelFormat::kRgb,  PixelFormat::kBgr,  PixelFormat::kMjpeg};

// As configuration and messages call it: "grey", "y10p", "bayer".
[[nodiscard]] const char* pixel_format_name(PixelFormat format);

// Nothing for formats that the driver cannot read.
[[nodiscard]] std::optional<PixelFormat> pixel_format_of(std::uint32_t fourcc);

// V4L2's codes of one format: one, or four for the Bayer orders.
[[nodiscard]] std::span<const std::uint32_t> fourccs_of(PixelFormat format);

// "YUYV"; bytes that are no letters become '?'.
[[nodiscard]] std::string fourcc_text(std::uint32_t fourcc);

// Whether the first plane already is 8-bit grey, so that nothing needs converting.
[[nodiscard]] bool is_grey_in_place(PixelFormat format);

// Whether images are of another length each, and to_grey() cannot read them: JpegLuma does.
[[nodiscard]] bool is_compressed(PixelFormat format);

// The size of the grey image that becomes of a device's: half of it for Bayer, else the same.
[[nodiscard]] ImageExtent grey_extent(PixelFormat format, ImageExtent device);

// The bytes of a row that hold pixels; padding may follow. Of a compressed image there are no rows:
// those of its grey image.
[[nodiscard]] std::ptrdiff_t row_bytes(PixelFormat format, int width_px);

// How far into an image to_grey() reads; of a compressed one, the least it can have. @param
// stride_bytes  from row to row, >= row_bytes().
[[nodiscard]] std::size_t image_bytes(PixelFormat format, ImageExtent device,
                                      std::ptrdiff_t stride_bytes);

// Writes the image as 8-bit grey: the upper 8 bits of deeper pixels, those above their depth's
// range being white; luma, for RGB by the weights of ITU-R BT.601 in 256ths; the rounded mean of
// each 2x2 Bayer cell.
// @pre the format is not compressed.
// @param source  image_bytes() of readable bytes, of any alignment.
// @param grey    of grey_extent().
// Exactness: integers only, the same on every machine.
void to_grey(PixelFormat format, const std::uint8_t* source, std::ptrdiff_t stride_bytes,
             const ImageView<std::uint8_t>& grey);

}  // namespace darkling
