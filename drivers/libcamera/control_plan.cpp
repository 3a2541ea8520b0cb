// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/control_plan.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"

namespace darkling {

namespace {

constexpr double kUsPerMs = 1000.0;
constexpr double kRateTolerance = 0.99;  // 30 means 29.97 to many a camera

double nearest(double value, const ControlRange& range) {
  return std::clamp(value, range.least, std::max(range.least, range.most));
}

void plan_rate(const CameraConfig& config, const CameraControls& controls, const std::string& name,
               ControlPlan& plan) {
  if (!controls.period_us) {
    plan.remarks.push_back(name + ": takes no frame rate; the camera chooses its own");
    return;
  }
  const double wanted_us = 1e6 / config.rate_hz;
  const double period_us = nearest(wanted_us, *controls.period_us);
  plan.period_us = std::llround(period_us);
  if (wanted_us < period_us * kRateTolerance) {
    plan.remarks.push_back(name + ": gives " + number_text(1e6 / period_us) +
                           " frames a second, asked for were " + number_text(config.rate_hz));
  }
}

void plan_fixed_exposure(const CameraConfig& config, const CameraControls& controls,
                         const std::string& name, ControlPlan& plan) {
  if (!controls.exposure_us) {
    plan.remarks.push_back(name + ": takes no exposure time; the camera chooses its own");
    return;
  }
  double wanted_us = std::min(config.exposure_ms, config.max_exposure_ms) * kUsPerMs;
  if (plan.period_us) wanted_us = std::min(wanted_us, static_cast<double>(*plan.period_us));
  if (wanted_us < config.exposure_ms * kUsPerMs) {
    plan.remarks.push_back(name + ": the exposure of " + number_text(config.exposure_ms) +
                           " ms is cut to " + number_text(wanted_us / kUsPerMs) +
                           " ms, by max_exposure_ms or the frame's period");
  }
  plan.exposure_us =
      static_cast<std::int32_t>(std::lround(nearest(wanted_us, *controls.exposure_us)));
}

void plan_automatic_exposure(const CameraConfig& config, const CameraControls& controls,
                             const std::string& name, ControlPlan& plan) {
  if (!controls.has_automatic) {
    plan.remarks.push_back(name +
                           ": has no automatic exposure to switch on; exposure_ms sets it by hand");
    return;
  }
  const double bound_us = static_cast<double>(plan.period_us.value_or(0));
  if (bound_us == 0.0 || bound_us > config.max_exposure_ms * kUsPerMs) {
    plan.remarks.push_back(name +
                           ": its automatic exposure is bounded by the frame's period, not " +
                           "by max_exposure_ms = " + number_text(config.max_exposure_ms) +
                           "; exposure_ms sets it by hand");
  }
}

void plan_gain(const CameraConfig& config, const CameraControls& controls, const std::string& name,
               ControlPlan& plan) {
  if (config.gain <= 0.0) return;
  if (!controls.gain) {
    plan.remarks.push_back(name + ": takes no gain; the camera chooses its own");
    return;
  }
  plan.gain = static_cast<float>(nearest(config.gain, *controls.gain));
}

}  // namespace

ControlPlan plan_controls(const std::string& name, const CameraConfig& config,
                          const CameraControls& controls) {
  ControlPlan plan;
  plan_rate(config, controls, name, plan);
  if (config.exposure_ms > 0.0) {
    plan_fixed_exposure(config, controls, name, plan);
  } else {
    plan_automatic_exposure(config, controls, name, plan);
  }
  plan_gain(config, controls, name, plan);
  if (controls.has_automatic) plan.is_automatic = !(plan.exposure_us && plan.gain);
  return plan;
}

}  // namespace darkling
