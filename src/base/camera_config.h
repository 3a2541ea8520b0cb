// SPDX-License-Identifier: Apache-2.0
// What is asked of the cameras: plain values, which the configuration fills and drivers read.
#pragma once

#include <string>

namespace darkling {

// How the two eyes arrive.
enum class EyeLayout {
  kTwoDevices = 0,  // each eye is a device of its own; pairs are made by time
  kSideBySide,      // one image, left eye in its left half
  kTopBottom,       // one image, left eye in its upper half
};

enum class PixelFormat {
  kAny = 0,  // the first that the device offers, in the order below
  kGrey,     // 8 bits
  kY10,      // 10 bits in the low end of 16, little-endian
  kY10P,     // four pixels in five bytes, MIPI order
  kY12,      // 12 bits in the low end of 16, little-endian
  kY16,
  kYuyv,
  kUyvy,
  kNv12,   // or another format that begins with a plane of luma, where the driver knows one
  kBayer,  // any 8-bit Bayer order: each 2x2 cell becomes one grey pixel
  kRgb,    // bytes in this order
  kBgr,
  kMjpeg,  // a JPEG image each; its luma
};

struct CameraConfig {
  // "v4l2:/dev/video0" with one image of both eyes, "v4l2:/dev/video0,/dev/video1" with two
  // devices, "libcamera:ID[,ID]", "synthetic:SCENE[,key=value…]" or a frame log, played at its
  // pace.
  std::string source;
  EyeLayout layout = EyeLayout::kTwoDevices;
  bool swap_eyes = false;
  PixelFormat format = PixelFormat::kAny;
  int width_px =
      0;  // of the device's image, both eyes of a shared one together; 0: the calibration's
  int height_px = 0;
  double rate_hz = 20.0;
  double exposure_ms = 0.0;       // 0: the camera's own automatic, capped by max_exposure_ms
  double max_exposure_ms = 10.0;  // for blur; never more than a frame's period
  double gain = 0.0;              // in the device's own units; 0: automatic
  double max_skew_ms = 5.0;       // between the stamps of a pair's two eyes
};

}  // namespace darkling
