// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/camera_controls.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <linux/videodev2.h>

#include "base/number_text.h"

namespace darkling {

namespace {

constexpr double kExposureUnitsPerMs = 10.0;  // V4L2_CID_EXPOSURE_ABSOLUTE counts 100 us
constexpr double kRateTolerance = 0.99;       // 30 means 29.97 to many a camera

std::optional<std::int32_t> get_control(const DeviceDescriptor& device, std::uint32_t id) {
  v4l2_control control = {};
  control.id = id;
  if (device.ioctl(VIDIOC_G_CTRL, &control) < 0) return std::nullopt;
  return control.value;
}

bool set_control(const DeviceDescriptor& device, std::uint32_t id, std::int32_t value) {
  v4l2_control control = {};
  control.id = id;
  control.value = value;
  return device.ioctl(VIDIOC_S_CTRL, &control) == 0;
}

// Sets the value that the control can take nearest to `value`.
bool set_nearest(const DeviceDescriptor& device, std::uint32_t id, double value) {
  v4l2_queryctrl range = {};
  range.id = id;
  if (device.ioctl(VIDIOC_QUERYCTRL, &range) < 0) return false;
  if ((range.flags & V4L2_CTRL_FLAG_DISABLED) != 0 || range.maximum < range.minimum) return false;
  const double least = range.minimum;
  const double step = std::max(range.step, 1);
  const double inside = std::clamp(value, least, static_cast<double>(range.maximum));
  const double on_grid = least + std::floor((inside - least) / step + 0.5) * step;
  const bool is_above = on_grid > range.maximum;
  return set_control(device, id, static_cast<std::int32_t>(is_above ? on_grid - step : on_grid));
}

// Sensors without processing of their own have a gain of the analogue part only.
std::optional<std::uint32_t> gain_control(const DeviceDescriptor& device) {
  for (const std::uint32_t id : {V4L2_CID_GAIN, V4L2_CID_ANALOGUE_GAIN}) {
    if (get_control(device, id)) return id;
  }
  return std::nullopt;
}

void set_fixed_exposure(const DeviceDescriptor& device, const CameraConfig& config, Duration period,
                        std::vector<std::string>& remarks) {
  double wanted_ms = std::min(config.exposure_ms, config.max_exposure_ms);
  if (period > Duration::zero()) {
    wanted_ms = std::min(wanted_ms, static_cast<double>(period.count()) * 1e-6);
  }
  if (wanted_ms < config.exposure_ms) {
    remarks.push_back(device.path() + ": the exposure of " + number_text(config.exposure_ms) +
                      " ms is cut to " + number_text(wanted_ms) +
                      " ms, by max_exposure_ms or the frame's period");
  }
  // One of the two, or none on cameras that have no automatic.
  if (!set_control(device, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL)) {
    set_control(device, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_SHUTTER_PRIORITY);
  }
  if (!set_nearest(device, V4L2_CID_EXPOSURE_ABSOLUTE, wanted_ms * kExposureUnitsPerMs)) {
    remarks.push_back(device.path() + ": takes no exposure time; the camera chooses its own");
  }
}

void set_automatic_exposure(const DeviceDescriptor& device, const CameraConfig& config,
                            std::vector<std::string>& remarks) {
  if (!set_control(device, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY) &&
      !set_control(device, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_AUTO)) {
    remarks.push_back(device.path() +
                      ": has no automatic exposure to switch on; exposure_ms sets it by hand");
  }
  const double exposure_ms = read_exposure(device).exposure_ms;
  if (exposure_ms > config.max_exposure_ms) {
    remarks.push_back(device.path() + ": exposes for " + number_text(exposure_ms) +
                      " ms, and its automatic cannot be held below max_exposure_ms = " +
                      number_text(config.max_exposure_ms) + "; exposure_ms sets it by hand");
  }
}

void set_gain(const DeviceDescriptor& device, const CameraConfig& config,
              std::vector<std::string>& remarks) {
  const bool is_automatic = config.gain <= 0.0;
  set_control(device, V4L2_CID_AUTOGAIN, is_automatic ? 1 : 0);
  if (is_automatic) return;
  const auto control = gain_control(device);
  if (!control || !set_nearest(device, *control, config.gain)) {
    remarks.push_back(device.path() + ": takes no gain; the camera chooses its own");
  }
}

}  // namespace

Duration set_frame_rate(const DeviceDescriptor& device, double rate_hz,
                        std::vector<std::string>& remarks) {
  v4l2_streamparm request = {};
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.parm.capture.timeperframe.numerator = 1000;
  request.parm.capture.timeperframe.denominator =
      static_cast<std::uint32_t>(std::lround(rate_hz * 1000.0));
  const bool is_answered = device.ioctl(VIDIOC_S_PARM, &request) == 0;
  const v4l2_fract& period = request.parm.capture.timeperframe;
  if (!is_answered || (request.parm.capture.capability & V4L2_CAP_TIMEPERFRAME) == 0 ||
      period.numerator == 0 || period.denominator == 0) {
    remarks.push_back(device.path() + ": takes no frame rate; the camera chooses its own");
    return Duration::zero();
  }
  const double period_s = static_cast<double>(period.numerator) / period.denominator;
  if (1.0 / period_s < rate_hz * kRateTolerance) {
    remarks.push_back(device.path() + ": gives " + number_text(1.0 / period_s) +
                      " frames a second, asked for were " + number_text(rate_hz));
  }
  constexpr double kLongest_s = 3600.0;
  return Duration{std::llround(std::min(period_s, kLongest_s) * 1e9)};
}

void set_exposure(const DeviceDescriptor& device, const CameraConfig& config, Duration period,
                  std::vector<std::string>& remarks) {
  set_control(device, V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0);
  if (config.exposure_ms > 0.0) {
    set_fixed_exposure(device, config, period, remarks);
  } else {
    set_automatic_exposure(device, config, remarks);
  }
  set_gain(device, config, remarks);
}

ExposureReading read_exposure(const DeviceDescriptor& device) {
  ExposureReading reading;
  if (const auto units = get_control(device, V4L2_CID_EXPOSURE_ABSOLUTE); units && *units >= 0) {
    reading.exposure_ms = *units / kExposureUnitsPerMs;
  }
  if (const auto id = gain_control(device)) {
    if (const auto gain = get_control(device, *id); gain && *gain >= 0) reading.gain = *gain;
  }
  return reading;
}

}  // namespace darkling
