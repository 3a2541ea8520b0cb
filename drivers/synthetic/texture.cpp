// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/check.h"

namespace darkling::synthetic {

namespace {

constexpr int kChannels = 3;
// Slopes are stored as 128 + 63 · slope: up to 2 m per m, steps of 1/63.
constexpr float kSlopeScale = 63.0f;

std::uint8_t to_byte(float x) {
  return static_cast<std::uint8_t>(std::clamp(x + 0.5f, 0.0f, 255.0f));
}

// log2 of a positive float, wrong by at most 0.09: enough to choose a level of the pyramid.
float rough_log2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return static_cast<float>(bits) * (1.0f / 8388608.0f) - 127.0f;
}

// std::floor is a call into the mathematics library where the processor's rounding instruction may
// not be taken for granted.
int floor_to_int(float x) {
  const int i = static_cast<int>(x);
  return i - (static_cast<float>(i) > x ? 1 : 0);
}

// Spreads four bytes over four lanes of 16 bits: lanes 0, 2, 1, 3 of the texel.
std::uint64_t spread(std::uint32_t texel) {
  constexpr std::uint32_t kEven = 0x00ff00ffu;
  return (texel & kEven) | (static_cast<std::uint64_t>((texel >> 8) & kEven) << 32);
}

std::vector<float> halve(const std::vector<float>& values, int size) {
  const int half = size / 2;
  std::vector<float> reduced(static_cast<std::size_t>(half) * half * kChannels);
  for (int y = 0; y < half; ++y) {
    for (int x = 0; x < half; ++x) {
      for (int c = 0; c < kChannels; ++c) {
        const auto at = [&](int i, int j) {
          return values[(static_cast<std::size_t>(2 * y + j) * size + (2 * x + i)) * kChannels + c];
        };
        reduced[(static_cast<std::size_t>(y) * half + x) * kChannels + c] =
            0.25f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1));
      }
    }
  }
  return reduced;
}

}  // namespace

Texture::Texture(int size, float extent_m, const std::vector<float>& albedo,
                 const std::vector<float>& height_m)
    : extent_m_(extent_m), texels_per_m_(static_cast<float>(size) / extent_m) {
  const std::size_t count = static_cast<std::size_t>(size) * size;
  CHECK(size > 0 && (size & (size - 1)) == 0, "texture sizes are powers of two");
  CHECK(albedo.size() == count && (height_m.empty() || height_m.size() == count),
        "one value a texel");
  std::vector<float> values(count * kChannels, 0.0f);
  const float per_m = 0.5f * texels_per_m_;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * size + x;
      values[i * kChannels] = albedo[i];
      if (height_m.empty()) continue;
      const auto height = [&](int a, int b) {
        return height_m[static_cast<std::size_t>(b & (size - 1)) * size + (a & (size - 1))];
      };
      values[i * kChannels + 1] = (height(x + 1, y) - height(x - 1, y)) * per_m;
      values[i * kChannels + 2] = (height(x, y + 1) - height(x, y - 1)) * per_m;
    }
  }
  add_level(size, values);
  for (int s = size; s > 1; s /= 2) {
    values = halve(values, s);
    add_level(s / 2, values);
  }
}

void Texture::add_level(int size, const std::vector<float>& values) {
  Level level{size, static_cast<float>(size) / extent_m_, {}};
  level.texels.resize(level.place(size - 1, size - 1) + 1);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float* v = &values[(static_cast<std::size_t>(y) * size + x) * kChannels];
      level.texels[level.place(x, y)] =
          static_cast<std::uint32_t>(to_byte(255.0f * v[0])) |
          static_cast<std::uint32_t>(to_byte(128.0f + kSlopeScale * v[1])) << 8 |
          static_cast<std::uint32_t>(to_byte(128.0f + kSlopeScale * v[2])) << 16;
    }
  }
  levels_.push_back(std::move(level));
}

// The four texels around (u, v) with weights in 1/256 that add up to 1: each lane's sum is at most
// 255 · 256 and stays within its 16 bits.
void Texture::add_bilinear(const Level& level, float u, float v, float weight, float* sum) {
  const int x = floor_to_int(u * level.texels_per_m * 256.0f) - 128;
  const int y = floor_to_int(v * level.texels_per_m * 256.0f) - 128;
  const int mask = level.size - 1;
  const int x0 = (x >> 8) & mask;
  const int x1 = (x0 + 1) & mask;
  const int y0 = (y >> 8) & mask;
  const int y1 = (y0 + 1) & mask;
  const auto a = static_cast<std::uint64_t>(x & 255);
  const auto b = static_cast<std::uint64_t>(y & 255);
  const std::uint64_t ab = (a * b) >> 8;
  const std::uint64_t lanes = spread(level.at(x0, y0)) * (256 - a - b + ab) +
                              spread(level.at(x1, y0)) * (a - ab) +
                              spread(level.at(x0, y1)) * (b - ab) + spread(level.at(x1, y1)) * ab;
  sum[0] += weight * static_cast<float>(static_cast<int>(lanes & 0xffff));
  sum[1] += weight * static_cast<float>(static_cast<int>((lanes >> 32) & 0xffff));
  sum[2] += weight * static_cast<float>(static_cast<int>((lanes >> 16) & 0xffff));
}

Footprint Texture::footprint(const Eigen::Vector2f& axis_x, const Eigen::Vector2f& axis_y) const {
  const float x2 = axis_x.squaredNorm();
  const float y2 = axis_y.squaredNorm();
  // Seen at a slant a footprint is long and narrow. A pixel's samples lie in different rows and
  // columns and share out the length, so the level may be finer than the length alone asks for.
  const float width_m = std::sqrt(std::max({std::min(x2, y2), 0.25f * std::max(x2, y2), 1e-12f}));
  const int last = static_cast<int>(levels_.size()) - 1;
  const float level =
      std::clamp(rough_log2(width_m * texels_per_m_), 0.0f, static_cast<float>(last));
  const int fine = static_cast<int>(level);
  return {fine, std::min(fine + 1, last), level - static_cast<float>(fine)};
}

SurfaceSample Texture::sample(float u, float v, const Footprint& footprint) const {
  float sum[kChannels] = {};
  const float t = footprint.coarse_share;
  add_bilinear(levels_[footprint.fine], u, v, 1.0f - t, sum);
  if (t > 0.0f) add_bilinear(levels_[footprint.coarse], u, v, t, sum);
  constexpr float kSlope = 1.0f / (256.0f * kSlopeScale);
  constexpr float kFlat = 128.0f / kSlopeScale;
  return {sum[0] * (1.0f / (256.0f * 255.0f)), sum[1] * kSlope - kFlat, sum[2] * kSlope - kFlat};
}

}  // namespace darkling::synthetic
