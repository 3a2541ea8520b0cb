// SPDX-License-Identifier: Apache-2.0
// All that differs between the versions of libcamera from 0.0.3 on; nothing else asks for one.
#pragma once

#include <array>
#include <memory>

#include <libcamera/camera.h>
#include <libcamera/control_ids.h>
#include <libcamera/version.h>

#define DARKLING_LIBCAMERA_SINCE(minor) \
  (LIBCAMERA_VERSION_MAJOR > 0 || LIBCAMERA_VERSION_MINOR >= (minor))

namespace darkling::versions {

// Roles came in a vector, since 0.1 they come in a span.
inline std::unique_ptr<libcamera::CameraConfiguration> configuration_of(
    libcamera::Camera& camera, libcamera::StreamRole role) {
#if DARKLING_LIBCAMERA_SINCE(1)
  const std::array<libcamera::StreamRole, 1> roles = {role};
  return camera.generateConfiguration(
      libcamera::Span<const libcamera::StreamRole>(roles.data(), roles.size()));
#else
  return camera.generateConfiguration(libcamera::StreamRoles{role});
#endif
}

// Images as they are without any turning on request: that was a transform, since 0.2 it is an
// orientation. What the calibration saw was the same.
inline void leave_upright(libcamera::CameraConfiguration& configuration) {
#if DARKLING_LIBCAMERA_SINCE(2)
  configuration.orientation = libcamera::Orientation::Rotate0;
#else
  configuration.transform = libcamera::Transform::Identity;
#endif
}

// Until 0.5 a fixed exposure time or gain kept the automatic from it; since then each has a mode of
// its own beside the common switch, which the camera may lack.
inline void set_modes(const libcamera::ControlInfoMap& known, bool is_exposure_fixed,
                      bool is_gain_fixed, libcamera::ControlList& list) {
#if DARKLING_LIBCAMERA_SINCE(5)
  namespace controls = libcamera::controls;
  if (known.find(&controls::ExposureTimeMode) != known.end()) {
    list.set(controls::ExposureTimeMode,
             is_exposure_fixed ? controls::ExposureTimeModeManual : controls::ExposureTimeModeAuto);
  }
  if (known.find(&controls::AnalogueGainMode) != known.end()) {
    list.set(controls::AnalogueGainMode,
             is_gain_fixed ? controls::AnalogueGainModeManual : controls::AnalogueGainModeAuto);
  }
#else
  static_cast<void>(known);
  static_cast<void>(is_exposure_fixed);
  static_cast<void>(is_gain_fixed);
  static_cast<void>(list);
#endif
}

// Whether the camera can choose by itself: the switch, and since 0.5 perhaps a mode only.
inline bool has_automatic(const libcamera::ControlInfoMap& known) {
#if DARKLING_LIBCAMERA_SINCE(5)
  if (known.find(&libcamera::controls::ExposureTimeMode) != known.end()) return true;
#endif
  return known.find(&libcamera::controls::AeEnable) != known.end();
}

}  // namespace darkling::versions

#undef DARKLING_LIBCAMERA_SINCE
