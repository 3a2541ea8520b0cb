// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/module/camera_controls.h"

#include <array>

#include <libcamera/control_ids.h>

#include "drivers/libcamera/module/libcamera_versions.h"

namespace darkling {

namespace {

namespace controls = libcamera::controls;
using libcamera::ControlInfoMap;
using libcamera::ControlValue;

// Pipelines differ in the types of their limits; of an array there is no single one.
std::optional<double> as_number(const ControlValue& value) {
  if (value.isArray()) return std::nullopt;
  switch (value.type()) {
    case libcamera::ControlTypeInteger32:
      return value.get<std::int32_t>();
    case libcamera::ControlTypeInteger64:
      return static_cast<double>(value.get<std::int64_t>());
    case libcamera::ControlTypeFloat:
      return value.get<float>();
    default:
      return std::nullopt;
  }
}

std::optional<ControlRange> range_of(const ControlInfoMap& known, const libcamera::ControlId& id) {
  const auto found = known.find(&id);
  if (found == known.end()) return std::nullopt;
  const auto least = as_number(found->second.min());
  const auto most = as_number(found->second.max());
  if (!least || !most || *most <= 0.0) return std::nullopt;
  return ControlRange{.least = *least, .most = *most};
}

}  // namespace

CameraControls read_controls(const ControlInfoMap& known) {
  return {.has_automatic = versions::has_automatic(known),
          .exposure_us = range_of(known, controls::ExposureTime),
          .gain = range_of(known, controls::AnalogueGain),
          .period_us = range_of(known, controls::FrameDurationLimits)};
}

libcamera::ControlList control_list(const ControlInfoMap& known, const ControlPlan& plan) {
  libcamera::ControlList list(controls::controls);
  if (plan.is_automatic && known.find(&controls::AeEnable) != known.end()) {
    list.set(controls::AeEnable, *plan.is_automatic);
  }
  versions::set_modes(known, plan.exposure_us.has_value(), plan.gain.has_value(), list);
  if (plan.exposure_us) list.set(controls::ExposureTime, *plan.exposure_us);
  if (plan.gain) list.set(controls::AnalogueGain, *plan.gain);
  if (plan.period_us) {
    const std::array<std::int64_t, 2> limits = {*plan.period_us, *plan.period_us};
    list.set(controls::FrameDurationLimits, libcamera::Span<const std::int64_t, 2>(limits));
  }
  return list;
}

void read_metadata(const libcamera::ControlList& metadata, CompletedFrame& frame) {
  if (const auto exposure_us = metadata.get(controls::ExposureTime)) {
    frame.exposure_ms = *exposure_us * 1e-3;
  }
  if (const auto gain = metadata.get(controls::AnalogueGain)) frame.gain = *gain;
  if (const auto period_us = metadata.get(controls::FrameDuration)) {
    frame.period = std::chrono::microseconds(*period_us);
  }
  if (const auto stamp_ns = metadata.get(controls::SensorTimestamp); stamp_ns && *stamp_ns > 0) {
    frame.stamp_ns = *stamp_ns;
    frame.is_of_sensor = true;
  }
}

}  // namespace darkling
