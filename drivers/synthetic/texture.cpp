// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/texture.h"

#include <algorithm>
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
  int exponent = 0;
  const float mantissa = std::frexp(x, &exponent);  // 0.5…1
  return static_cast<float>(exponent) + 2.0f * (mantissa - 1.0f);
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
  Level level{size, std::vector<Texel>(static_cast<std::size_t>(size) * size)};
  for (std::size_t i = 0; i < level.texels.size(); ++i) {
    const float* v = &values[i * kChannels];
    level.texels[i] = {{to_byte(255.0f * v[0]), to_byte(128.0f + kSlopeScale * v[1]),
                        to_byte(128.0f + kSlopeScale * v[2]), 0}};
  }
  levels_.push_back(std::move(level));
}

void Texture::add_bilinear(const Level& level, float u, float v, float weight, float* sum) const {
  const float scale = static_cast<float>(level.size) / extent_m_;
  const float x = u * scale - 0.5f;
  const float y = v * scale - 0.5f;
  const float fx = std::floor(x);
  const float fy = std::floor(y);
  const int mask = level.size - 1;
  const int x0 = static_cast<int>(fx) & mask;
  const int x1 = (x0 + 1) & mask;
  const int y0 = static_cast<int>(fy) & mask;
  const int y1 = (y0 + 1) & mask;
  const float a = x - fx;
  const float b = (y - fy) * weight;
  const float c = weight - b;
  const Texel* row0 = level.texels.data() + static_cast<std::size_t>(y0) * level.size;
  const Texel* row1 = level.texels.data() + static_cast<std::size_t>(y1) * level.size;
  for (int k = 0; k < 4; ++k) {
    sum[k] += static_cast<float>(row0[x0].c[k]) * ((1.0f - a) * c) +
              static_cast<float>(row0[x1].c[k]) * (a * c) +
              static_cast<float>(row1[x0].c[k]) * ((1.0f - a) * b) +
              static_cast<float>(row1[x1].c[k]) * (a * b);
  }
}

SurfaceSample Texture::sample(float u, float v, const Eigen::Vector2f& axis_x,
                              const Eigen::Vector2f& axis_y) const {
  const float x2 = axis_x.squaredNorm();
  const float y2 = axis_y.squaredNorm();
  const Eigen::Vector2f& long_axis = x2 > y2 ? axis_x : axis_y;
  const float longer = std::sqrt(std::max(x2, y2));
  const float shorter = std::max(std::sqrt(std::min(x2, y2)), longer / kMaxTaps);
  const int taps =
      std::clamp(static_cast<int>(longer / std::max(shorter, 1e-9f) + 0.5f), 1, kMaxTaps);
  const float last = static_cast<float>(levels_.size() - 1);
  const float lod = std::clamp(rough_log2(std::max(shorter * texels_per_m_, 1e-6f)), 0.0f, last);
  const int fine = static_cast<int>(lod);
  const int coarse = std::min(fine + 1, static_cast<int>(levels_.size()) - 1);
  const float t = lod - static_cast<float>(fine);

  float sum[4] = {};
  const float weight = 1.0f / static_cast<float>(taps);
  for (int i = 0; i < taps; ++i) {
    const float s = (static_cast<float>(i) + 0.5f) * weight - 0.5f;
    const float tap_u = u + s * long_axis.x();
    const float tap_v = v + s * long_axis.y();
    add_bilinear(levels_[fine], tap_u, tap_v, (1.0f - t) * weight, sum);
    if (t > 0.0f) add_bilinear(levels_[coarse], tap_u, tap_v, t * weight, sum);
  }
  return {sum[0] * (1.0f / 255.0f), (sum[1] - 128.0f) * (1.0f / kSlopeScale),
          (sum[2] - 128.0f) * (1.0f / kSlopeScale)};
}

}  // namespace darkling::synthetic
