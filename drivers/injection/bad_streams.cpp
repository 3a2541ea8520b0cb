// SPDX-License-Identifier: Apache-2.0
// Injections that leave nothing of one image or both.
#include "drivers/injection/pixels.h"
#include "drivers/injection/transport.h"
#include "drivers/sensor/mix64.h"
#include "drivers/sensor/photon_noise.h"

namespace darkling {

namespace {

// Any level is as likely.
void fill_with_noise(std::uint64_t key, const ImageView<std::uint8_t>& image) {
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* row = image.row(y);
    const std::uint64_t row_key = key + static_cast<std::uint64_t>(y) * image.width;
    for (int x = 0; x < image.width; ++x) {
      row[x] = static_cast<std::uint8_t>(mix64(row_key + static_cast<std::uint64_t>(x)) >> 56);
    }
  }
}

// What a sensor without light delivers: its black level and read noise of one level.
void fill_with_darkness(std::uint64_t key, const ImageView<std::uint8_t>& image) {
  const NormalQuantiles& normal = NormalQuantiles::get();
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* row = image.row(y);
    const std::uint64_t row_key = key + static_cast<std::uint64_t>(y) * image.width;
    for (int x = 0; x < image.width; ++x) {
      const float noise = normal(mix64(row_key + static_cast<std::uint64_t>(x)));
      row[x] = to_level(static_cast<float>(kBlackLevel) + noise);
    }
  }
}

void fill_both(std::uint8_t level, InjectedPair& pair) {
  fill_pixels(level, pair.left);
  fill_pixels(level, pair.right);
}

}  // namespace

void apply_black(const Injection& /*injection*/, InjectedPair& pair) {
  fill_both(0, pair);
}

void apply_white(const Injection& /*injection*/, InjectedPair& pair) {
  fill_both(255, pair);
}

void apply_constant(const Injection& injection, InjectedPair& pair) {
  fill_both(static_cast<std::uint8_t>(injection.value), pair);
}

void apply_noise(const Injection& injection, InjectedPair& pair) {
  fill_with_noise(noise_key(injection, pair.sequence, kLeftEye), pair.left);
  fill_with_noise(noise_key(injection, pair.sequence, kRightEye), pair.right);
}

void apply_blackout(const Injection& injection, InjectedPair& pair) {
  fill_with_darkness(noise_key(injection, pair.sequence, kLeftEye), pair.left);
  fill_with_darkness(noise_key(injection, pair.sequence, kRightEye), pair.right);
}

void apply_cover(const Injection& injection, InjectedPair& pair) {
  const bool is_left = injection.value == 0.0;  // "left|right"
  const int eye = is_left ? kLeftEye : kRightEye;
  fill_with_darkness(noise_key(injection, pair.sequence, eye), is_left ? pair.left : pair.right);
}

void apply_same_eyes(const Injection& /*injection*/, InjectedPair& pair) {
  copy_pixels(pair.left, pair.right);
}

}  // namespace darkling
