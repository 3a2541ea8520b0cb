// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "drivers/sensor/photon_noise.h"
#include "support/plain_source.h"

namespace darkling {
namespace {

using test::inject;
using test::PlainPair;

constexpr ImageSize kSize{.width = 200, .height = 150};

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments moments_of(const std::vector<std::uint8_t>& levels) {
  Moments m;
  const auto count = static_cast<double>(levels.size());
  for (const std::uint8_t level : levels) m.mean += level / count;
  for (const std::uint8_t level : levels) {
    m.variance += (level - m.mean) * (level - m.mean) / count;
  }
  return m;
}

// Photon transfer: with G levels an electron, variance = G² (electrons + 1² of reading) + 1/12 of
// rounding.
TEST(InjectElectrons, HasTheMeanOfTheSourceAndTheNoiseOfSoManyPhotons) {
  constexpr double kLevel = 60.0;
  for (const double electrons : {12.0, 25.0, 39.0, 41.0, 200.0, 5000.0}) {
    const auto pairs =
        inject(kSize, test::flat_pairs(kSize, 1, 60), {"electrons=" + std::to_string(electrons)});
    const double gain = kLevel / electrons;
    const double variance = gain * gain * (electrons + 1.0) + 1.0 / 12.0;
    for (const auto& eye : {pairs[0].left, pairs[0].right}) {
      const Moments m = moments_of(eye);
      EXPECT_NEAR(m.mean, kBlackLevel + kLevel, 5.0 * std::sqrt(variance / 30000.0)) << electrons;
      EXPECT_NEAR(m.variance / variance, 1.0, 0.05) << electrons;
    }
  }
}

// One electron is 20 levels: the read noise smears the counts, but what is cut off at 0 is the
// reading of empty pixels below −0.15 electrons.
TEST(InjectElectrons, LeavesMostPixelsBlackWhenHalfAnElectronComes) {
  const auto pairs = inject(kSize, test::flat_pairs(kSize, 1, 10), {"electrons=0.5"});
  int black = 0;
  for (const std::uint8_t level : pairs[0].left) black += level == 0 ? 1 : 0;
  // P(0) P(r < -0.125) + P(1) P(r < -1.125) + P(2) P(r < -2.125), a level of 0 being below 0.5.
  const double expected = 0.6065 * 0.4503 + 0.3033 * 0.1303 + 0.0758 * 0.0168;
  EXPECT_NEAR(black / 30000.0, expected, 0.015);
}

TEST(InjectElectrons, KeepsTheContrastOfThePictureOnAverage) {
  const auto clean = test::drifting_pairs(kSize, 1);
  const auto pairs = inject(kSize, clean, {"electrons=5000"});
  double worst = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < clean[0].left.size(); ++i) {
    const double error = pairs[0].left[i] - kBlackLevel - clean[0].left[i];
    worst = std::max(worst, std::abs(error));
    sum += error;
  }
  EXPECT_LT(worst, 12.0);
  EXPECT_NEAR(sum / static_cast<double>(clean[0].left.size()), 0.0, 0.05);
}

TEST(InjectElectrons, DiffersByPixelEyeFrameAndSeedAndByNothingElse) {
  const auto flat = test::flat_pairs(kSize, 3, 50);
  const auto once = inject(kSize, flat, {"electrons=10"});
  EXPECT_EQ(once, inject(kSize, flat, {"electrons=10"}));
  EXPECT_EQ(once, inject(kSize, flat, {"electrons=10,seed=1"}));
  EXPECT_NE(once[0].left, once[0].right);
  EXPECT_NE(once[0].left, once[1].left);
  EXPECT_NE(once[0].left, inject(kSize, flat, {"electrons=10,seed=2"})[0].left);
  const std::vector<PlainPair> last = {flat[2]};
  EXPECT_EQ(once[2], inject(kSize, last, {"electrons=10"})[0]) << "without the frames before";
}

// Neither along rows nor along columns nor from one frame or eye to the other.
TEST(InjectElectrons, IsWhite) {
  const auto pairs = inject(kSize, test::flat_pairs(kSize, 2, 80), {"electrons=100"});
  const auto correlation = [](const std::vector<std::uint8_t>& a,
                              const std::vector<std::uint8_t>& b, std::size_t shift) {
    const Moments m = moments_of(a);
    double sum = 0.0;
    for (std::size_t i = 0; i + shift < a.size(); ++i) {
      sum += (a[i] - m.mean) * (b[i + shift] - m.mean);
    }
    return sum / (m.variance * static_cast<double>(a.size() - shift));
  };
  const auto& left = pairs[0].left;
  for (const std::size_t shift : {1, 2, 200, 201}) {
    EXPECT_LT(std::abs(correlation(left, left, shift)), 0.03) << shift;
  }
  EXPECT_LT(std::abs(correlation(left, pairs[0].right, 0)), 0.03);
  EXPECT_LT(std::abs(correlation(left, pairs[1].left, 0)), 0.03);
}

TEST(InjectElectrons, TakesABlackPictureForNoLight) {
  const auto pairs = inject(kSize, test::flat_pairs(kSize, 1, 0), {"electrons=10"});
  const Moments m = moments_of(pairs[0].left);
  EXPECT_NEAR(m.mean, kBlackLevel, 0.05);
  EXPECT_LT(m.variance, 0.2) << "a tenth of a level an electron";
}

}  // namespace
}  // namespace darkling
