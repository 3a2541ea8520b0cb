// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/v4l2_source.h"

#include <algorithm>
#include <cmath>

#include "drivers/v4l2/eye_layout.h"
#include "drivers/v4l2/v4l2_spec.h"

namespace darkling {

namespace {

// A skew of half a period or more could pair a frame with the one before its own.
Duration pairing_skew(double max_skew_ms, double rate_hz) {
  return Duration{std::llround(std::min(max_skew_ms, 500.0 / rate_hz) * 1e6)};
}

Result<void> check_settings(const CameraConfig& config, std::size_t devices, ImageExtent eye) {
  const bool is_shared = config.layout != EyeLayout::kTwoDevices;
  if (is_shared != (devices == 1)) {
    return failure(ExitCode::kConfiguration,
                   config.source + " names " + std::to_string(devices) +
                       (is_shared ? " devices, but the layout is of one image with both eyes"
                                  : " device, but the layout is of two devices"));
  }
  if (eye.width <= 0 || eye.height <= 0 || config.width_px < 0 || config.height_px < 0) {
    return failure(ExitCode::kConfiguration, config.source + ": an image size is not positive");
  }
  constexpr double kMaxRate_hz = 1000.0;
  if (!(config.rate_hz > 0.0 && config.rate_hz <= kMaxRate_hz)) {
    return failure(ExitCode::kConfiguration,
                   config.source + ": the frame rate must be above 0 and at most 1000 a second");
  }
  if (!(config.exposure_ms >= 0.0 && config.max_exposure_ms > 0.0 && config.gain >= 0.0 &&
        config.max_skew_ms >= 0.0)) {
    return failure(ExitCode::kConfiguration,
                   config.source +
                       ": exposure, gain and skew must not be negative, and the "
                       "longest exposure must be above 0");
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<V4l2Source>> V4l2Source::create(const CameraConfig& config, ImageExtent eye,
                                                       DeviceCalls& calls) {
  auto paths = parse_v4l2(config.source);
  if (!paths) return tl::unexpected<Error>(paths.error());
  if (auto fits = check_settings(config, paths->size(), eye); !fits) {
    return tl::unexpected<Error>(fits.error());
  }
  if (config.swap_eyes) std::reverse(paths->begin(), paths->end());
  return std::unique_ptr<V4l2Source>(new V4l2Source(config, std::move(*paths), eye, calls));
}

V4l2Source::V4l2Source(const CameraConfig& config, std::vector<std::string> paths, ImageExtent eye,
                       DeviceCalls& calls)
    : config_(config), paths_(std::move(paths)), eye_(eye), calls_(calls) {}

V4l2Source::~V4l2Source() {
  stop();
}

Result<void> V4l2Source::start() {
  CHECK(devices_[0] == nullptr, "stop() comes before another start()");
  auto opened = open_devices();
  if (!opened) {
    clear();
    return opened;
  }
  if (last_stamp_) numbers_.restart(pairs_since(*last_stamp_));
  published_stats_.store(stats_);
  published_camera_.store(devices_[0]->state());
  return {};
}

// About how many pairs the cameras would have given.
std::int64_t V4l2Source::pairs_since(FrameTime stamp) const {
  const auto away_ns = static_cast<double>(to_ns(calls_.now()) - to_ns(stamp));
  return std::max<std::int64_t>(std::llround(away_ns * 1e-9 * config_.rate_hz), 0);
}

Result<void> V4l2Source::open_devices() {
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    auto device = V4l2Device::open(calls_, paths_[i], config_, eye_);
    if (!device) return tl::unexpected<Error>(device.error());
    devices_[i] = std::move(*device);
  }
  claim_slots();
  // One right after the other: two cameras that only start together then stay together.
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    if (auto on = devices_[i]->stream_on(); !on) return on;
  }
  return {};
}

void V4l2Source::claim_slots() {
  double rate_hz = config_.rate_hz;  // the fastest that a device may have
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    rate_hz = std::max(rate_hz, devices_[i]->state().rate_hz);
    const ImageFormat& format = devices_[i]->format();
    if (is_grey_in_place(format.format)) continue;
    const ImageExtent grey = grey_extent(format.format, format.extent);
    for (Slot& slot : slots_) {
      slot.copies[i].resize(static_cast<std::size_t>(grey.width) * grey.height);
    }
  }
  pairing_.emplace(pairing_skew(config_.max_skew_ms, rate_hz));
}

void V4l2Source::stop() {
  if (devices_[0] == nullptr) return;
  for (const Slot& slot : slots_) {
    CHECK(slot.state.load(std::memory_order_acquire) != SlotState::kOnLoan,
          "every lease is back before stop()");
  }
  clear();
}

void V4l2Source::clear() {
  for (auto& device : devices_) device.reset();
  for (Slot& slot : slots_) {
    slot.state.store(SlotState::kFree, std::memory_order_relaxed);
    slot.buffers = {-1, -1};
    for (auto& copy : slot.copies) std::vector<std::uint8_t>().swap(copy);
  }
  is_readable_ = {};
  indices_ = {};
  pairing_.reset();
  last_skew_ = Duration::zero();
  stats_ = {};
}

std::vector<std::string> V4l2Source::remarks() const {
  std::vector<std::string> all;
  for (const auto& device : devices_) {
    if (device == nullptr) continue;
    all.insert(all.end(), device->remarks().begin(), device->remarks().end());
    if (device->is_lost()) all.push_back(device->loss());
  }
  return all;
}

}  // namespace darkling
