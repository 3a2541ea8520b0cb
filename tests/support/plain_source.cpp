// SPDX-License-Identifier: Apache-2.0
#include "support/plain_source.h"

#include <memory>
#include <stdexcept>

#include "drivers/injection/injected_source.h"
#include "drivers/sensor/mix64.h"
#include "support/pixels.h"

namespace darkling::test {

namespace {

// Linear between random levels 8 px apart.
std::uint8_t texture_level(int x, int y) {
  constexpr int kCell = 8;
  const auto node = [](int i, int j) {
    const auto key = static_cast<std::uint64_t>(i + 1000) * 100003 + static_cast<std::uint64_t>(j);
    return 40.0f + 120.0f * unit_float(static_cast<std::uint32_t>(mix64(key)));
  };
  const float u = static_cast<float>(x % kCell) / kCell;
  const float v = static_cast<float>(y % kCell) / kCell;
  const int i = x / kCell;
  const int j = y / kCell;
  const float above = node(i, j) + u * (node(i + 1, j) - node(i, j));
  const float below = node(i, j + 1) + u * (node(i + 1, j + 1) - node(i, j + 1));
  return static_cast<std::uint8_t>(above + v * (below - above) + 0.5f);
}

PlainPair blank_pair(ImageSize size, int index) {
  const std::size_t count = static_cast<std::size_t>(size.width) * size.height;
  return {.sequence = index,
          .stamp = frame_time_from_ns(1'000'000'000 + 50'000'000LL * index),
          .left = std::vector<std::uint8_t>(count),
          .right = std::vector<std::uint8_t>(count)};
}

}  // namespace

Result<void> PlainSource::start() {
  next_ = 0;
  stats_ = {};
  return {};
}

WaitResult PlainSource::wait_next(Duration /*timeout*/) {
  if (next_ == pairs_.size()) return {.status = WaitStatus::kEndOfSource};
  const PlainPair& pair = pairs_[next_++];
  if (pair.fault != FrameFault::kNone) {
    ++stats_.unpaired;
    return {.status = WaitStatus::kBadFrame,
            .fault = pair.fault,
            .sequence = pair.sequence,
            .stamp = pair.stamp};
  }
  ++stats_.delivered;
  const StereoFrame frame{.sequence = pair.sequence,
                          .stamp = pair.stamp,
                          .left = {pair.left.data(), size_.width, size_.height, size_.width},
                          .right = {pair.right.data(), size_.width, size_.height, size_.width}};
  return {.status = WaitStatus::kFrame,
          .lease = FrameLease(
              frame, [](void*, int) {}, this, 0)};
}

std::vector<PlainPair> drifting_pairs(ImageSize size, int count) {
  std::vector<PlainPair> pairs;
  for (int index = 0; index < count; ++index) {
    PlainPair pair = blank_pair(size, index);
    std::size_t i = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x, ++i) {
        pair.left[i] = texture_level(x + 2 * index, y);
        pair.right[i] = texture_level(x + 2 * index + 4, y);
      }
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<PlainPair> flat_pairs(ImageSize size, int count, std::uint8_t level) {
  std::vector<PlainPair> pairs;
  for (int index = 0; index < count; ++index) {
    PlainPair pair = blank_pair(size, index);
    pair.left.assign(pair.left.size(), level);
    pair.right.assign(pair.right.size(), level);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<PlainPair> play_all(FrameSource& source) {
  if (!source.start()) throw std::runtime_error("the source does not start");
  std::vector<PlainPair> pairs;
  while (true) {
    const WaitResult next = source.wait_next(Duration(0));
    if (next.status == WaitStatus::kEndOfSource) break;
    if (next.status == WaitStatus::kBadFrame) {
      pairs.push_back({.sequence = next.sequence, .stamp = next.stamp, .fault = next.fault});
      continue;
    }
    if (next.status != WaitStatus::kFrame) throw std::runtime_error("the source has got stuck");
    const StereoFrame& frame = next.lease.frame();
    pairs.push_back({.sequence = frame.sequence,
                     .stamp = frame.stamp,
                     .left = pixels_of(frame.left),
                     .right = pixels_of(frame.right)});
  }
  source.stop();
  return pairs;
}

std::vector<PlainPair> inject(ImageSize size, const std::vector<PlainPair>& pairs,
                              const std::vector<std::string>& injections) {
  const auto parsed = parse_injections(injections);
  if (!parsed) throw std::runtime_error(parsed.error().message);
  InjectedSource source(std::make_unique<PlainSource>(size, pairs), size, *parsed);
  return play_all(source);
}

}  // namespace darkling::test
