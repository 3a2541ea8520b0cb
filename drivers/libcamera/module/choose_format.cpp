// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/module/choose_format.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/camera/eye_layout.h"
#include "drivers/libcamera/drm_formats.h"
#include "drivers/libcamera/module/libcamera_versions.h"

namespace darkling {

namespace {

constexpr unsigned kBufferCount = 4;  // asked for; pipelines may give others
// Beyond any camera's; their product fits 32 bits.
constexpr unsigned kMaxStride_bytes = 1U << 17;
constexpr int kMaxSide_px = 8192;
// Processed images first; raw ones of sensors without colour are as good.
constexpr auto kRoles = std::to_array({libcamera::StreamRole::Viewfinder,  //
                                       libcamera::StreamRole::Raw});

std::string extent_text(ImageExtent extent) {
  return std::to_string(extent.width) + "x" + std::to_string(extent.height);
}

// What the camera made of a request, if it is what was asked for and makes sense.
std::optional<ImageFormat> accept(const libcamera::StreamConfiguration& answer,
                                  const DrmFormat& wanted, ImageExtent extent) {
  const auto stride_bytes = static_cast<std::ptrdiff_t>(answer.stride);
  if (answer.pixelFormat != libcamera::PixelFormat(wanted.fourcc, wanted.modifier) ||
      answer.size.width != static_cast<unsigned>(extent.width) ||
      answer.size.height != static_cast<unsigned>(extent.height) ||
      answer.stride > kMaxStride_bytes || stride_bytes < row_bytes(wanted.format, extent.width)) {
    return std::nullopt;
  }
  return ImageFormat{.format = wanted.format,
                     .fourcc = wanted.fourcc,
                     .extent = extent,
                     .stride_bytes = stride_bytes,
                     .bytes = image_bytes(wanted.format, extent, stride_bytes)};
}

bool gives_eyes_of(const CameraConfig& config, PixelFormat format, ImageExtent image,
                   ImageExtent eye) {
  return std::max(image.width, image.height) <= kMaxSide_px &&
         eye_extent(config.layout, grey_extent(format, image)) == eye;
}

std::string offers_text(const libcamera::StreamConfiguration& stream) {
  std::string text;
  for (const libcamera::PixelFormat& format : stream.formats().pixelformats()) {
    const libcamera::SizeRange range = stream.formats().range(format);
    text += (text.empty() ? "" : ", ") + format.toString() + " " + range.toString();
  }
  return text;
}

// @param offers  gets what the camera says it has and what it made of requests.
std::optional<ImageFormat> try_formats(libcamera::CameraConfiguration& configuration,
                                       const CameraConfig& config, ImageExtent eye,
                                       std::string& offers) {
  libcamera::StreamConfiguration& stream = configuration.at(0);
  offers = offers_text(stream);
  const auto offered = stream.formats().pixelformats();
  for (const DrmFormat& wanted : drm_formats()) {
    if (config.format != PixelFormat::kAny && config.format != wanted.format) continue;
    const libcamera::PixelFormat format(wanted.fourcc, wanted.modifier);
    if (std::find(offered.begin(), offered.end(), format) == offered.end()) continue;
    const ImageExtent extent = wanted_extent(config, wanted.format, eye);
    if (!gives_eyes_of(config, wanted.format, extent, eye)) continue;
    stream.pixelFormat = format;
    stream.size = {static_cast<unsigned>(extent.width), static_cast<unsigned>(extent.height)};
    stream.bufferCount = kBufferCount;
    versions::leave_upright(configuration);
    if (configuration.validate() == libcamera::CameraConfiguration::Invalid) continue;
    if (auto accepted = accept(stream, wanted, extent)) return accepted;
    offers += " (makes " + stream.toString() + " of " + extent_text(extent) + ")";
  }
  return std::nullopt;
}

}  // namespace

Result<ChosenFormat> choose_format(libcamera::Camera& camera, const CameraConfig& config,
                                   ImageExtent eye) {
  std::vector<std::string> offers;  // by role, each once: many cameras have one stream for all
  for (const libcamera::StreamRole role : kRoles) {
    auto configuration = versions::configuration_of(camera, role);
    if (configuration == nullptr || configuration->empty()) continue;
    std::string offered;
    const auto format = try_formats(*configuration, config, eye, offered);
    if (format) return ChosenFormat{.configuration = std::move(configuration), .format = *format};
    if (std::find(offers.begin(), offers.end(), offered) == offers.end()) offers.push_back(offered);
  }
  std::string text = "no format";
  for (std::size_t i = 0; i < offers.size(); ++i) {
    text = i == 0 ? offers[i] : text + "; or raw: " + offers[i];
  }
  return failure(ExitCode::kDeviceUnavailable,
                 "libcamera camera \"" + camera.id() +
                     "\": no format fits; wanted: " + pixel_format_name(config.format) + " at " +
                     extent_text(wanted_extent(config, config.format, eye)) +
                     " for eyes of the calibration's " + extent_text(eye) +
                     "; the camera offers: " + text);
}

}  // namespace darkling
