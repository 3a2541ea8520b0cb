// SPDX-License-Identifier: Apache-2.0
#include "drivers/camera/pixel_formats.h"

#include <algorithm>
#include <cstring>

#include <linux/videodev2.h>

#include "base/check.h"

namespace darkling {

namespace {

constexpr std::size_t kLeastJpeg_bytes = 4;  // its beginning and its end

struct Format {
  PixelFormat format;
  const char* name;
  std::array<std::uint32_t, 4> fourccs;  // 0: none
};

constexpr std::array<Format, kPixelFormats.size()> kFormats = {{
    {PixelFormat::kGrey, "grey", {V4L2_PIX_FMT_GREY}},
    {PixelFormat::kY10, "y10", {V4L2_PIX_FMT_Y10}},
    {PixelFormat::kY10P, "y10p", {V4L2_PIX_FMT_Y10P}},
    {PixelFormat::kY12, "y12", {V4L2_PIX_FMT_Y12}},
    {PixelFormat::kY16, "y16", {V4L2_PIX_FMT_Y16}},
    {PixelFormat::kYuyv, "yuyv", {V4L2_PIX_FMT_YUYV}},
    {PixelFormat::kUyvy, "uyvy", {V4L2_PIX_FMT_UYVY}},
    {PixelFormat::kNv12, "nv12", {V4L2_PIX_FMT_NV12}},
    {PixelFormat::kBayer,
     "bayer",
     {V4L2_PIX_FMT_SBGGR8, V4L2_PIX_FMT_SGBRG8, V4L2_PIX_FMT_SGRBG8, V4L2_PIX_FMT_SRGGB8}},
    {PixelFormat::kRgb, "rgb", {V4L2_PIX_FMT_RGB24}},
    {PixelFormat::kBgr, "bgr", {V4L2_PIX_FMT_BGR24}},
    {PixelFormat::kMjpeg, "mjpeg", {V4L2_PIX_FMT_MJPEG}},
}};

const Format* find_format(PixelFormat format) {
  const auto* found = std::find_if(kFormats.begin(), kFormats.end(),
                                   [&](const Format& known) { return known.format == format; });
  return found == kFormats.end() ? nullptr : found;
}

// Every `step`-th byte, from `first` on.
void take_bytes(const std::uint8_t* source, int first, int step, std::span<std::uint8_t> grey) {
  const std::uint8_t* from = source + first;
  for (std::uint8_t& pixel : grey) {
    pixel = *from;
    from += step;
  }
}

// Little-endian words whose low end holds the pixel, `8 + shift` bits deep.
void take_words(const std::uint8_t* source, int shift, std::span<std::uint8_t> grey) {
  for (std::size_t x = 0; x < grey.size(); ++x) {
    const int word = source[2 * x] | source[2 * x + 1] << 8;
    grey[x] = static_cast<std::uint8_t>(std::min(word >> shift, 255));
  }
}

// Five bytes for four pixels: their upper 8 bits each, then what is left of all four.
void take_packed(const std::uint8_t* source, std::span<std::uint8_t> grey) {
  for (std::size_t x = 0; x < grey.size(); ++x) grey[x] = source[x / 4 * 5 + x % 4];
}

void take_cells(const std::uint8_t* upper, const std::uint8_t* lower,
                std::span<std::uint8_t> grey) {
  for (std::size_t x = 0; x < grey.size(); ++x) {
    const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
    grey[x] = static_cast<std::uint8_t>((sum + 2) / 4);
  }
}

// Three bytes a pixel; the weights sum to 256, so that white stays white.
void take_colours(const std::uint8_t* source, int red, int blue, std::span<std::uint8_t> grey) {
  for (std::size_t x = 0; x < grey.size(); ++x) {
    const std::uint8_t* pixel = source + 3 * x;
    const int sum = 77 * pixel[red] + 150 * pixel[1] + 29 * pixel[blue];
    grey[x] = static_cast<std::uint8_t>((sum + 128) / 256);
  }
}

void take_row(PixelFormat format, const std::uint8_t* source, std::ptrdiff_t stride_bytes,
              std::span<std::uint8_t> grey) {
  switch (format) {
    case PixelFormat::kGrey:
    case PixelFormat::kNv12:
      std::memcpy(grey.data(), source, grey.size());
      return;
    case PixelFormat::kY10:
      take_words(source, 2, grey);
      return;
    case PixelFormat::kY12:
      take_words(source, 4, grey);
      return;
    case PixelFormat::kY16:
      take_words(source, 8, grey);
      return;
    case PixelFormat::kY10P:
      take_packed(source, grey);
      return;
    case PixelFormat::kYuyv:
      take_bytes(source, 0, 2, grey);
      return;
    case PixelFormat::kUyvy:
      take_bytes(source, 1, 2, grey);
      return;
    case PixelFormat::kBayer:
      take_cells(source, source + stride_bytes, grey);
      return;
    case PixelFormat::kRgb:
      take_colours(source, 0, 2, grey);
      return;
    case PixelFormat::kBgr:
      take_colours(source, 2, 0, grey);
      return;
    case PixelFormat::kMjpeg:
    case PixelFormat::kAny:
      break;
  }
  CHECK(false, "an image that is read row by row is of one format, and not compressed");
}

}  // namespace

const char* pixel_format_name(PixelFormat format) {
  const Format* known = find_format(format);
  return known == nullptr ? "any" : known->name;
}

std::optional<PixelFormat> pixel_format_of(std::uint32_t fourcc) {
  for (const Format& known : kFormats) {
    for (const std::uint32_t code : known.fourccs) {
      if (code == fourcc && code != 0) return known.format;
    }
  }
  return std::nullopt;
}

std::span<const std::uint32_t> fourccs_of(PixelFormat format) {
  const Format* known = find_format(format);
  if (known == nullptr) return {};
  return std::span(known->fourccs).first(format == PixelFormat::kBayer ? 4 : 1);
}

std::string fourcc_text(std::uint32_t fourcc) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>(fourcc >> shift & 0x7F);
    text += letter >= ' ' && letter <= '~' ? letter : '?';
  }
  return text;
}

bool is_grey_in_place(PixelFormat format) {
  return format == PixelFormat::kGrey || format == PixelFormat::kNv12;
}

bool is_compressed(PixelFormat format) {
  return format == PixelFormat::kMjpeg;
}

ImageExtent grey_extent(PixelFormat format, ImageExtent device) {
  if (format != PixelFormat::kBayer) return device;
  return {.width = device.width / 2, .height = device.height / 2};
}

std::ptrdiff_t row_bytes(PixelFormat format, int width_px) {
  const std::ptrdiff_t width = width_px;
  switch (format) {
    case PixelFormat::kY10:
    case PixelFormat::kY12:
    case PixelFormat::kY16:
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
      return 2 * width;
    case PixelFormat::kY10P:
      return (width * 5 + 3) / 4;
    case PixelFormat::kRgb:
    case PixelFormat::kBgr:
      return 3 * width;
    default:
      return width;
  }
}

std::size_t image_bytes(PixelFormat format, ImageExtent device, std::ptrdiff_t stride_bytes) {
  if (device.width <= 0 || device.height <= 0) return 0;
  if (is_compressed(format)) return kLeastJpeg_bytes;
  return static_cast<std::size_t>((device.height - 1) * stride_bytes +
                                  row_bytes(format, device.width));
}

void to_grey(PixelFormat format, const std::uint8_t* source, std::ptrdiff_t stride_bytes,
             const ImageView<std::uint8_t>& grey) {
  const std::ptrdiff_t step = format == PixelFormat::kBayer ? 2 * stride_bytes : stride_bytes;
  for (int y = 0; y < grey.height; ++y) {
    take_row(format, source + y * step, stride_bytes,
             {grey.row(y), static_cast<std::size_t>(grey.width)});
  }
}

}  // namespace darkling
