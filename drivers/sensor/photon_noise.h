// SPDX-License-Identifier: Apache-2.0
// The noise of light and of the amplifier behind it, drawn from hashed bits.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace darkling {

// Level of a pixel without light and noise: keeps the read noise from being cut off at 0.
inline constexpr double kBlackLevel = 3.0;

// Above this mean a Poisson count is drawn as a rounded normal: skewness 1/√λ is below 0.16.
inline constexpr double kNormalFromElectrons = 40.0;

// Normal numbers of mean 0 and variance 1, by their quantiles; none beyond ±3.7.
class NormalQuantiles {
 public:
  // Made at the first call. Thread: any.
  [[nodiscard]] static const NormalQuantiles& get();

  // @param bits  random; the topmost 12 count.
  [[nodiscard]] float operator()(std::uint64_t bits) const {
    return quantiles_[static_cast<std::size_t>(bits >> 52)];
  }

 private:
  static constexpr int kCount = 4096;
  NormalQuantiles();
  std::array<float, kCount> quantiles_ = {};
};

// A Poisson count by adding up the distribution until it passes a uniform number.
// @param bits  random; the upper 24 count. @pre mean < kNormalFromElectrons.
// Cost: grows with the count; see PoissonTable for means that repeat.
[[nodiscard]] float draw_poisson(float mean, std::uint64_t bits);

// Poisson counts of many pixels but few means: the distributions are added up once.
class PoissonTable {
 public:
  static constexpr int kMeanCount = 256;  // one for each grey level

  PoissonTable() : sums_(kMeanCount), starts_(kMeanCount) {}

  // @pre 0 <= mean < kNormalFromElectrons.
  void set_mean(int index, double mean);

  // @param bits  random. Cost: two look-ups on average, whatever the mean.
  [[nodiscard]] int draw(int index, std::uint32_t bits) const {
    const Sums& sums = sums_[static_cast<std::size_t>(index)];
    std::size_t count = starts_[static_cast<std::size_t>(index)][bits >> 24];
    while (bits > sums[count]) ++count;
    return static_cast<int>(count);
  }

 private:
  static constexpr int kMostCount = 127;  // 13 standard deviations above the highest mean
  // P(at most k) in units of 2⁻³²; the last is all ones, which ends every search.
  using Sums = std::array<std::uint32_t, kMostCount + 1>;
  // Where the search begins for each of 256 equal slices.
  using Starts = std::array<std::uint8_t, 256>;

  std::vector<Sums> sums_;
  std::vector<Starts> starts_;
};

}  // namespace darkling
