// SPDX-License-Identifier: Apache-2.0
#include "kernels/match_patch.h"

#include <array>
#include <cmath>

#include "kernels/bit_planes.h"
#include "support/pixels.h"
#include "support/random.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedLayout;
using test::Random;

constexpr int kSide = 2 * kCodePatchRadius + 1;

// The definition, one bit at a time: left patch about (3, 3), right patch about (x, 3).
int hamming_oracle(const ImageView<const std::uint8_t>& left,
                   const ImageView<const std::uint8_t>& right, int x) {
  int bits = 0;
  for (int i = 0; i < kSide * kSide * 8; ++i) {
    const int dx = i / 8 % kSide;
    const int dy = i / 8 / kSide;
    const int c = i % 8;
    const int l = left.at(dx, dy) >> c & 1;
    const int r = right.at(x - kCodePatchRadius + dx, dy) >> c & 1;
    bits += l != r ? 1 : 0;
  }
  return bits;
}

class EachMatchCodes : public ::testing::TestWithParam<KernelTable> {};

// The left image is the patch alone; the right one is as wide as the disparities need.
TEST_P(EachMatchCodes, EqualTheOracleAndTheReferenceForEveryCount) {
  unsigned seed = 1;
  for (int count = 1; count <= 70; ++count) {
    for (const Fill fill : test::kAllFills) {
      for (const test::GuardSide guard :
           {test::GuardSide::kBehindLastRow, test::GuardSide::kBeforeFirstRow}) {
        const GuardedLayout patch = {
            .width = kSide,
            .height = kSide,
            .row_padding = 1 + count % 4,
            .distance_to_guard = guard == test::GuardSide::kBehindLastRow ? 1 : 0,  // is read
            .guard = guard};
        SCOPED_TRACE(test::describe(patch, fill) + ", count " + std::to_string(count));
        const GuardedLayout row = test::resized(patch, kSide + count - 1, kSide);
        GuardedImage<std::uint8_t> left(patch);
        GuardedImage<std::uint8_t> right(row);
        GuardedImage<int> cost({.width = count, .height = 1});
        GuardedImage<int> expected({.width = count, .height = 1});
        test::fill_image(left.view(), fill, seed++);
        test::fill_image(right.view(), fill, seed++);
        const std::uint8_t* l = left.view().row(kCodePatchRadius) + kCodePatchRadius;
        const int x_first = kCodePatchRadius + count - 1;
        const std::uint8_t* r = right.view().row(kCodePatchRadius) + x_first;
        const std::ptrdiff_t l_stride = left.view().stride;
        const std::ptrdiff_t r_stride = right.view().stride;
        GetParam().match_codes(l, l_stride, r, r_stride, count, cost.view().data);
        match_codes_ref(l, l_stride, r, r_stride, count, expected.view().data);
        for (int k = 0; k < count; ++k) {
          ASSERT_EQ(cost.view().at(k, 0), hamming_oracle(left.view(), right.view(), x_first - k))
              << k;
        }
        ASSERT_EQ(test::pixels_of(cost.view()), test::pixels_of(expected.view()));
        ASSERT_TRUE(cost.padding_is_untouched());
      }
    }
  }
}

TEST_P(EachMatchCodes, CostNothingAtTheTrueDisparityAndAllBitsOfTheInverse) {
  GuardedImage<std::uint8_t> left({.width = 40, .height = kSide, .distance_to_guard = 1});
  GuardedImage<std::uint8_t> right({.width = 40, .height = kSide, .distance_to_guard = 1});
  test::fill_image(left.view(), Fill::kUniform, 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < 40; ++x) right.view().at(x, y) = left.view().at(std::min(x + 9, 39), y);
  }
  std::array<int, 20> cost = {};
  const std::uint8_t* l = left.view().row(3) + 30;
  GetParam().match_codes(l, left.view().stride, right.view().row(3) + 30, right.view().stride, 20,
                         cost.data());
  EXPECT_EQ(cost[9], 0);
  EXPECT_EQ(std::count(cost.begin(), cost.end(), 0), 1);
  for (int i = 0; i < 40 * kSide; ++i) {
    std::uint8_t& code = right.view().at(i % 40, i / 40);
    code = static_cast<std::uint8_t>(~code);
  }
  GetParam().match_codes(l, left.view().stride, right.view().row(3) + 30, right.view().stride, 20,
                         cost.data());
  EXPECT_EQ(cost[9], kSide * kSide * 8);
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachMatchCodes, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

// The pixels that compare_patch may read, and no more: the left patch about pixel 2, the right one
// from pixel 1 on.
constexpr int kLeftWidth = 5;
constexpr int kRightWidth = 4;
constexpr int kRows = 3;

struct ExpectedFit {
  double gr = 0.0;
  double gg = 0.0;
  double rr = 0.0;
};

// The sums in doubles; all of it is exact there. `r_step` is what residuals are rounded to.
ExpectedFit fit_oracle(const ImageView<const std::uint8_t>& left,
                       const ImageView<const std::uint8_t>& right, int fraction_q12,
                       double r_step) {
  ExpectedFit fit;
  for (int i = 0; i < 9 * kPlaneCount; ++i) {
    const int c = i % kPlaneCount;
    const int column = i / kPlaneCount % 3;
    const int y = i / kPlaneCount / 3;
    const auto phi = [c, y](const ImageView<const std::uint8_t>& planes, int x) {
      return static_cast<double>(planes.at(x * kPlaneCount + c, y));
    };
    const double value =
        std::lerp(phi(right, column), phi(right, column + 1), fraction_q12 / 4096.0);
    const double r = test::round_half_up(value / r_step) * r_step - phi(left, column + 1);
    const double g = 0.5 * (phi(left, column + 2) - phi(left, column));
    fit.gr += g * r;
    fit.gg += g * g;
    fit.rr += r * r;
  }
  return fit;
}

class EachComparePatch : public ::testing::TestWithParam<KernelTable> {
 protected:
  static PatchFit compare(ComparePatchFn* compare_patch, const GuardedImage<std::uint8_t>& left,
                          const GuardedImage<std::uint8_t>& right, int fraction_q12) {
    return compare_patch(left.view().row(1) + 2 * kPlaneCount, left.view().stride,
                         right.view().row(1) + kPlaneCount, right.view().stride, fraction_q12);
  }
  static void check(const GuardedLayout& layout, Fill fill, int fraction_q12, unsigned seed) {
    SCOPED_TRACE(test::describe(layout, fill) + ", fraction " + std::to_string(fraction_q12));
    GuardedImage<std::uint8_t> left(test::resized(layout, kLeftWidth * kPlaneCount, kRows));
    GuardedImage<std::uint8_t> right(test::resized(layout, kRightWidth * kPlaneCount, kRows));
    test::fill_image(left.view(), fill, seed);
    test::fill_image(right.view(), fill, seed + 1000);
    const PatchFit fit = compare(GetParam().compare_patch, left, right, fraction_q12);
    const ExpectedFit oracle = fit_oracle(left.view(), right.view(), fraction_q12, 1.0 / 16.0);
    EXPECT_EQ(fit.gr, 32.0 * oracle.gr);
    EXPECT_EQ(fit.gg, 4.0 * oracle.gg);
    EXPECT_EQ(fit.rr, 256.0 * oracle.rr);
    const PatchFit expected = compare(compare_patch_ref, left, right, fraction_q12);
    EXPECT_EQ(fit.gr, expected.gr);
    EXPECT_EQ(fit.gg, expected.gg);
    EXPECT_EQ(fit.rr, expected.rr);
  }
};

TEST_P(EachComparePatch, EqualsTheOracleAndTheReferenceAtEveryFraction) {
  Random random(1);
  unsigned seed = 1;
  for (const test::GuardSide guard :
       {test::GuardSide::kBehindLastRow, test::GuardSide::kBeforeFirstRow}) {
    for (const int distance : {0, 1, 7}) {
      for (const Fill fill : test::kAllFills) {
        const GuardedLayout layout = {.width = 0,
                                      .height = 0,
                                      .row_padding = distance,
                                      .distance_to_guard = distance,
                                      .guard = guard};
        for (const int fraction_q12 : {0, 1, 127, 128, 2047, 2048, 4095}) {
          check(layout, fill, fraction_q12, seed++);
        }
        for (int trial = 0; trial < 100 && !HasFailure(); ++trial) {
          check(layout, fill, random.integer(0, 4095), seed++);
        }
      }
    }
  }
}

TEST_P(EachComparePatch, RoundsResidualsByLessThanAThirtySecond) {
  Random random(2);
  for (unsigned seed = 0; seed < 200; ++seed) {
    GuardedImage<std::uint8_t> left({.width = kLeftWidth * kPlaneCount, .height = kRows});
    GuardedImage<std::uint8_t> right({.width = kRightWidth * kPlaneCount, .height = kRows});
    test::fill_image(left.view(), Fill::kUniform, seed);
    test::fill_image(right.view(), Fill::kUniform, seed + 1000);
    const int fraction_q12 = random.integer(0, 4095);
    const PatchFit fit = compare(GetParam().compare_patch, left, right, fraction_q12);
    const ExpectedFit exact = fit_oracle(left.view(), right.view(), fraction_q12, 1.0 / 4096.0);
    // Cauchy and Schwarz, with 72 residuals off by 1/32 at the most.
    const double bound = std::sqrt(kPlanePatchValues) / 32.0;
    ASSERT_NEAR(fit.gr / 32.0, exact.gr, bound * std::sqrt(exact.gg));
    ASSERT_NEAR(std::sqrt(fit.rr / 256.0), std::sqrt(exact.rr), bound);
  }
}

TEST_P(EachComparePatch, ReachesItsGreatestSumsWithoutOverflow) {
  GuardedImage<std::uint8_t> left({.width = kLeftWidth * kPlaneCount, .height = kRows});
  GuardedImage<std::uint8_t> right({.width = kRightWidth * kPlaneCount, .height = kRows});
  for (const unsigned level : {0U, 255U}) {
    test::fill_image(left.view(), Fill::kConstant, level);
    test::fill_image(right.view(), Fill::kConstant, 255 - level);
    for (const int fraction_q12 : {0, 1000, 4095}) {
      const PatchFit fit = compare(GetParam().compare_patch, left, right, fraction_q12);
      EXPECT_EQ(fit.rr, kPlanePatchValues * 4080 * 4080);
      EXPECT_EQ(fit.gr, 0);
      EXPECT_EQ(fit.gg, 0);
    }
  }
}

// On a ramp the fit's step, Σ g r / Σ g², is how far the right patch lies from the left one.
TEST_P(EachComparePatch, FitsTheShiftOfARampExactly) {
  GuardedImage<std::uint8_t> left({.width = kLeftWidth * kPlaneCount, .height = kRows});
  GuardedImage<std::uint8_t> right({.width = kRightWidth * kPlaneCount, .height = kRows});
  for (int i = 0; i < kLeftWidth * kPlaneCount * kRows; ++i) {
    const int x = i % (kLeftWidth * kPlaneCount);
    const int slope = 4 * (x % kPlaneCount) - 16;  // one a plane, some falling
    const int level = 128 + slope * (x / kPlaneCount - 2);
    left.view().at(x, i / (kLeftWidth * kPlaneCount)) = static_cast<std::uint8_t>(level);
    if (x < kRightWidth * kPlaneCount) {  // pixel 1 holds what the left pixel 2 does
      const int shifted = 128 + slope * (x / kPlaneCount - 1);
      right.view().at(x, i / (kLeftWidth * kPlaneCount)) = static_cast<std::uint8_t>(shifted);
    }
  }
  for (const int fraction_q12 : {0, 256, 1024, 2048, 3072}) {
    const PatchFit fit = compare(GetParam().compare_patch, left, right, fraction_q12);
    EXPECT_EQ(fit.gr * 4096.0, 8.0 * fit.gg * fraction_q12);
    EXPECT_EQ(fit.rr == 0, fraction_q12 == 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachComparePatch, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

}  // namespace
}  // namespace darkling
