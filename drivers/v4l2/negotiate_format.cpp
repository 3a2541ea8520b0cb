// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/negotiate_format.h"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string>
#include <vector>

#include <linux/videodev2.h>

#include "drivers/camera/eye_layout.h"
#include "drivers/camera/jpeg_luma.h"

namespace darkling {

namespace {

// No device has as many formats or sizes; one that never ends its list is not followed for ever.
constexpr std::uint32_t kMaxListed = 64;
// Beyond any camera's; their product fits 32 bits, so what a device says overflows nothing.
constexpr std::uint32_t kMaxStride_bytes = 1U << 17;
constexpr int kMaxSide_px = 8192;

std::string extent_text(ImageExtent extent) {
  return std::to_string(extent.width) + "x" + std::to_string(extent.height);
}

std::vector<std::uint32_t> list_formats(const DeviceDescriptor& device) {
  std::vector<std::uint32_t> fourccs;
  for (std::uint32_t index = 0; index < kMaxListed; ++index) {
    v4l2_fmtdesc description = {};
    description.index = index;
    description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (device.ioctl(VIDIOC_ENUM_FMT, &description) < 0) break;
    fourccs.push_back(description.pixelformat);
  }
  return fourccs;
}

std::string sizes_text(const DeviceDescriptor& device, std::uint32_t fourcc) {
  std::string text;
  for (std::uint32_t index = 0; index < kMaxListed; ++index) {
    v4l2_frmsizeenum size = {};
    size.index = index;
    size.pixel_format = fourcc;
    if (device.ioctl(VIDIOC_ENUM_FRAMESIZES, &size) < 0) break;
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
      const v4l2_frmsize_stepwise& range = size.stepwise;
      return " " + std::to_string(range.min_width) + "x" + std::to_string(range.min_height) +
             " to " + std::to_string(range.max_width) + "x" + std::to_string(range.max_height);
    }
    text += " " + std::to_string(size.discrete.width) + "x" + std::to_string(size.discrete.height);
  }
  return text;
}

std::string offers_text(const DeviceDescriptor& device, const std::vector<std::uint32_t>& offered) {
  std::string text;
  for (const std::uint32_t fourcc : offered) {
    text += (text.empty() ? "" : ", ") + fourcc_text(fourcc) + sizes_text(device, fourcc);
  }
  return text.empty() ? "no format" : text;
}

// What the device made of a request, if it is what was asked for and makes sense.
std::optional<ImageFormat> accept(const v4l2_format& answer, PixelFormat format,
                                  std::uint32_t fourcc, ImageExtent wanted) {
  const v4l2_pix_format& pixels = answer.fmt.pix;
  const bool is_whole_frame = pixels.field == V4L2_FIELD_NONE || pixels.field == V4L2_FIELD_ANY;
  const std::ptrdiff_t least_bytes = row_bytes(format, wanted.width);
  const std::ptrdiff_t stride_bytes = pixels.bytesperline == 0 || is_compressed(format)
                                          ? least_bytes
                                          : static_cast<std::ptrdiff_t>(pixels.bytesperline);
  if (pixels.pixelformat != fourcc || pixels.width != static_cast<std::uint32_t>(wanted.width) ||
      pixels.height != static_cast<std::uint32_t>(wanted.height) || !is_whole_frame ||
      pixels.bytesperline > kMaxStride_bytes || stride_bytes < least_bytes) {
    return std::nullopt;
  }
  return ImageFormat{.format = format,
                     .fourcc = fourcc,
                     .extent = wanted,
                     .stride_bytes = stride_bytes,
                     .bytes = image_bytes(format, wanted, stride_bytes)};
}

// @param error  the last one that was not a plain refusal, 0 if there was none.
std::optional<ImageFormat> try_format(const DeviceDescriptor& device, PixelFormat format,
                                      std::uint32_t fourcc, ImageExtent wanted, int& error) {
  v4l2_format request = {};
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.fmt.pix.width = static_cast<std::uint32_t>(wanted.width);
  request.fmt.pix.height = static_cast<std::uint32_t>(wanted.height);
  request.fmt.pix.pixelformat = fourcc;
  request.fmt.pix.field = V4L2_FIELD_NONE;
  if (const int answer = device.ioctl(VIDIOC_S_FMT, &request); answer < 0) {
    if (answer != -EINVAL) error = answer;
    return std::nullopt;
  }
  return accept(request, format, fourcc, wanted);
}

bool gives_eyes_of(const CameraConfig& config, PixelFormat format, ImageExtent image,
                   ImageExtent eye) {
  return std::max(image.width, image.height) <= kMaxSide_px &&
         eye_extent(config.layout, grey_extent(format, image)) == eye;
}

Error nothing_fits(const DeviceDescriptor& device, const CameraConfig& config, ImageExtent eye,
                   const std::vector<std::uint32_t>& offered) {
  return {.code = ExitCode::kDeviceUnavailable,
          .message = device.path() +
                     ": no format fits; wanted: " + pixel_format_name(config.format) + " at " +
                     extent_text(wanted_extent(config, config.format, eye)) +
                     " for eyes of the calibration's " + extent_text(eye) +
                     (can_decode_jpeg() ? "" : " (but for mjpeg: built without libjpeg)") +
                     "; the device offers: " + offers_text(device, offered)};
}

}  // namespace

Result<void> check_captures(const DeviceDescriptor& device) {
  v4l2_capability capability = {};
  if (const int error = device.ioctl(VIDIOC_QUERYCAP, &capability); error < 0) {
    return tl::unexpected<Error>(device_error(device.path(), "VIDIOC_QUERYCAP", error));
  }
  const bool is_of_node = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  const std::uint32_t can = is_of_node ? capability.device_caps : capability.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    const bool is_planar = (can & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0;
    return failure(ExitCode::kDeviceUnavailable,
                   device.path() + (is_planar ? ": captures only through the multi-planar "
                                                "interface, which this driver does not speak; "
                                                "use libcamera for this camera"
                                              : ": is no video capture device (cameras often have "
                                                "a second node for metadata); name another node"));
  }
  if ((can & V4L2_CAP_STREAMING) == 0) {
    return failure(ExitCode::kDeviceUnavailable,
                   device.path() + ": does not stream into buffers, which this driver needs");
  }
  return {};
}

Result<ImageFormat> negotiate_format(const DeviceDescriptor& device, const CameraConfig& config,
                                     ImageExtent eye) {
  if (auto captures = check_captures(device); !captures) {
    return tl::unexpected<Error>(captures.error());
  }
  const std::vector<std::uint32_t> offered = list_formats(device);
  int error = 0;
  for (const PixelFormat format : kPixelFormats) {
    if (config.format != PixelFormat::kAny && config.format != format) continue;
    if (is_compressed(format) && !can_decode_jpeg()) continue;
    const ImageExtent wanted = wanted_extent(config, format, eye);
    if (!gives_eyes_of(config, format, wanted, eye)) continue;
    for (const std::uint32_t fourcc : fourccs_of(format)) {
      if (std::find(offered.begin(), offered.end(), fourcc) == offered.end()) continue;
      if (const auto found = try_format(device, format, fourcc, wanted, error)) return *found;
    }
  }
  if (error != 0) return tl::unexpected<Error>(device_error(device.path(), "VIDIOC_S_FMT", error));
  return tl::unexpected<Error>(nothing_fits(device, config, eye, offered));
}

bool has_format(const DeviceDescriptor& device, const ImageFormat& format) {
  v4l2_format now = {};
  now.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (device.ioctl(VIDIOC_G_FMT, &now) < 0) return false;
  const auto same = accept(now, format.format, format.fourcc, format.extent);
  return same && same->stride_bytes == format.stride_bytes;
}

}  // namespace darkling
