// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/drm_formats.h"

#include <array>

namespace darkling {

namespace {

constexpr std::uint32_t code(const char (&letters)[5]) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<std::uint8_t>(letters[i]);
  return value;
}

constexpr std::uint64_t kMipiPacked = 11ULL << 56 | 1;

// The names of RGB say how a little-endian word holds them: the bytes come in reverse.
constexpr auto kFormats = std::to_array<DrmFormat>({
    {code("R8  "), 0, PixelFormat::kGrey},
    {code("NV12"), 0, PixelFormat::kNv12},
    {code("NV21"), 0, PixelFormat::kNv12},
    {code("NV16"), 0, PixelFormat::kNv12},
    {code("YU12"), 0, PixelFormat::kNv12},
    {code("YV12"), 0, PixelFormat::kNv12},
    {code("YU16"), 0, PixelFormat::kNv12},
    {code("R10 "), 0, PixelFormat::kY10},
    {code("R10 "), kMipiPacked, PixelFormat::kY10P},
    {code("R12 "), 0, PixelFormat::kY12},
    {code("R16 "), 0, PixelFormat::kY16},
    {code("YUYV"), 0, PixelFormat::kYuyv},
    {code("UYVY"), 0, PixelFormat::kUyvy},
    {code("BG24"), 0, PixelFormat::kRgb},
    {code("RG24"), 0, PixelFormat::kBgr},
    {code("BA81"), 0, PixelFormat::kBayer},
    {code("GBRG"), 0, PixelFormat::kBayer},
    {code("GRBG"), 0, PixelFormat::kBayer},
    {code("RGGB"), 0, PixelFormat::kBayer},
});

}  // namespace

std::span<const DrmFormat> drm_formats() {
  return kFormats;
}

}  // namespace darkling
