// SPDX-License-Identifier: Apache-2.0
// Injections of pairs that are lost, damaged or mixed up on their way.
#include <algorithm>
#include <utility>

#include "drivers/injection/pixels.h"
#include "drivers/injection/transport.h"
#include "drivers/sensor/mix64.h"

namespace darkling {

namespace {

// True with the probability that is the injection's value.
bool happens(const Injection& injection, std::int64_t sequence) {
  const std::uint64_t random = noise_key(injection, sequence, kBothEyes);
  return static_cast<double>(random >> 11) * 0x1p-53 < injection.value;
}

// A block of up to a quarter of the image's sides somewhere in it, of random levels.
void overwrite_block(std::uint64_t key, const ImageView<std::uint8_t>& image) {
  const auto below = [&key](int count) {
    key = mix64(key);
    return static_cast<int>(key % static_cast<std::uint64_t>(count));
  };
  const int width = 1 + below(std::max(image.width / 4, 1));
  const int height = 1 + below(std::max(image.height / 4, 1));
  const int left = below(image.width - width + 1);
  const int top = below(image.height - height + 1);
  for (int y = top; y < top + height; ++y) {
    std::uint8_t* row = image.row(y);
    for (int x = left; x < left + width; ++x) {
      key = mix64(key);
      row[x] = static_cast<std::uint8_t>(key);
    }
  }
}

}  // namespace

FrameFault apply_drop(const Injection& injection, InjectedPair& pair) {
  return happens(injection, pair.sequence) ? FrameFault::kUnreadable : FrameFault::kNone;
}

// By the sequence, so that frame N − 1 is the first to go.
FrameFault apply_drop_every(const Injection& injection, InjectedPair& pair) {
  const auto period = static_cast<std::int64_t>(injection.value);
  const bool is_due = pair.sequence % period == period - 1;
  return is_due ? FrameFault::kUnreadable : FrameFault::kNone;
}

void apply_corrupt(const Injection& injection, InjectedPair& pair) {
  if (!happens(injection, pair.sequence)) return;
  constexpr std::uint64_t kMostBlocks = 8;
  const std::uint64_t random = noise_key(injection, pair.sequence, kPath);
  const ImageView<std::uint8_t>& image = (random >> 63) == 0 ? pair.left : pair.right;
  const std::uint64_t blocks = 1 + random % kMostBlocks;
  for (std::uint64_t i = 0; i < blocks; ++i) overwrite_block(mix64(random + i), image);
}

void apply_swap(const Injection& /*injection*/, InjectedPair& pair) {
  std::swap(pair.left, pair.right);
}

}  // namespace darkling
