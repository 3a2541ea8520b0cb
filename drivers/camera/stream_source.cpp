// SPDX-License-Identifier: Apache-2.0
#include "drivers/camera/stream_source.h"

#include <algorithm>
#include <cmath>

namespace darkling {

namespace {

// A skew of half a period or more could pair a frame with the one before its own.
Duration pairing_skew(double max_skew_ms, double rate_hz) {
  return Duration{std::llround(std::min(max_skew_ms, 500.0 / rate_hz) * 1e6)};
}

}  // namespace

StreamSource::StreamSource(const CameraConfig& config, std::vector<std::string> names,
                           ImageExtent eye, std::unique_ptr<CameraStreams> cameras)
    : config_(config), names_(std::move(names)), eye_(eye), cameras_(std::move(cameras)) {
  CHECK(names_.size() == 1 || names_.size() == 2, "a rig is one camera or two");
  if (config_.swap_eyes) std::reverse(names_.begin(), names_.end());
}

StreamSource::~StreamSource() {
  StreamSource::stop();
}

Result<void> StreamSource::start() {
  CHECK(streams_[0] == nullptr, "stop() comes before another start()");
  auto opened = open_streams();
  if (!opened) {
    clear();
    return opened;
  }
  if (last_stamp_) numbers_.restart(pairs_since(*last_stamp_));
  published_stats_.store(stats_);
  published_camera_.store(streams_[0]->state());
  return {};
}

// About how many pairs the cameras would have given.
std::int64_t StreamSource::pairs_since(FrameTime stamp) const {
  const auto away_ns = static_cast<double>(to_ns(cameras_->now()) - to_ns(stamp));
  return std::max<std::int64_t>(std::llround(away_ns * 1e-9 * config_.rate_hz), 0);
}

Result<void> StreamSource::open_streams() {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    auto stream = cameras_->open(names_[i], config_, eye_);
    if (!stream) return tl::unexpected<Error>(stream.error());
    streams_[i] = std::move(*stream);
  }
  claim_slots();
  // One right after the other: two cameras that only start together then stay together.
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (auto on = streams_[i]->stream_on(); !on) return on;
  }
  return {};
}

void StreamSource::claim_slots() {
  double rate_hz = config_.rate_hz;  // the fastest that a camera may have
  for (std::size_t i = 0; i < names_.size(); ++i) {
    rate_hz = std::max(rate_hz, streams_[i]->state().rate_hz);
    const ImageFormat& format = streams_[i]->format();
    if (is_grey_in_place(format.format)) continue;
    const ImageExtent grey = grey_extent(format.format, format.extent);
    if (is_compressed(format.format)) decoders_[i].emplace(grey.width);
    for (Slot& slot : slots_) {
      slot.copies[i].resize(static_cast<std::size_t>(grey.width) * grey.height);
    }
  }
  pairing_.emplace(pairing_skew(config_.max_skew_ms, rate_hz));
}

void StreamSource::stop() {
  if (streams_[0] == nullptr) return;
  for (const Slot& slot : slots_) {
    CHECK(slot.state.load(std::memory_order_acquire) != SlotState::kOnLoan,
          "every lease is back before stop()");
  }
  clear();
}

void StreamSource::clear() {
  for (auto& stream : streams_) stream.reset();
  cameras_->all_closed();
  for (Slot& slot : slots_) {
    slot.state.store(SlotState::kFree, std::memory_order_relaxed);
    slot.buffers = {-1, -1};
    for (auto& copy : slot.copies) std::vector<std::uint8_t>().swap(copy);
  }
  for (auto& decoder : decoders_) decoder.reset();
  indices_ = {};
  pairing_.reset();
  last_skew_ = Duration::zero();
  stats_ = {};
}

std::vector<std::string> StreamSource::remarks() const {
  std::vector<std::string> all;
  for (const auto& stream : streams_) {
    if (stream == nullptr) continue;
    all.insert(all.end(), stream->remarks().begin(), stream->remarks().end());
    if (stream->is_lost()) all.push_back(stream->loss());
  }
  return all;
}

}  // namespace darkling
