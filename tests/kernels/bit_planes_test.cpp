// SPDX-License-Identifier: Apache-2.0
#include "kernels/bit_planes.h"

#include <random>

#include "support/bit_planes_oracle.h"
#include "support/pixels.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedLayout;
using test::pixels_of;

constexpr int kMaxWidth = 3 * 32 + 4;  // px, past three of the widest vectors
// Both ends of the range, its middle, and what noise leads to.
constexpr int kDeadZones[] = {0, 1, 2, 5, 12, 40, 127, 128, 254, 255};

// The scratch of one width, right before a guard page.
class GuardedScratch {
 public:
  explicit GuardedScratch(int width)
      : bytes_({.width = static_cast<int>(bit_planes_scratch_bytes(width)), .height = 1}) {}
  [[nodiscard]] std::span<std::uint8_t> span() {
    return {bytes_.view().data, static_cast<std::size_t>(bytes_.view().width)};
  }
  [[nodiscard]] auto padding_is_untouched() const { return bytes_.padding_is_untouched(); }

 private:
  GuardedImage<std::uint8_t> bytes_;
};

struct Outcome {
  std::vector<std::uint8_t> codes;
  std::vector<std::uint8_t> planes;
};

// Runs one variant on `grey`, outputs in guarded memory shaped as `layout`.
Outcome run(BitPlanesFn* bit_planes, const ImageView<const std::uint8_t>& grey,
            const GuardedLayout& layout, int dead_zone = 0) {
  GuardedImage<std::uint8_t> codes(layout);
  GuardedImage<std::uint8_t> planes(
      test::resized(layout, layout.width * kPlaneCount, layout.height));
  GuardedScratch scratch(layout.width);
  bit_planes(grey, dead_zone, codes.view(), scratch.span(), planes.view());
  EXPECT_TRUE(codes.padding_is_untouched());
  EXPECT_TRUE(planes.padding_is_untouched());
  EXPECT_TRUE(scratch.padding_is_untouched());
  return {pixels_of(codes.view()), pixels_of(planes.view())};
}

class EachBitPlanes : public ::testing::TestWithParam<KernelTable> {
 protected:
  [[nodiscard]] static Outcome run_param(const ImageView<const std::uint8_t>& grey,
                                         int dead_zone = 0) {
    return run(GetParam().bit_planes, grey, {.width = grey.width, .height = grey.height},
               dead_zone);
  }
};

TEST_P(EachBitPlanes, EqualTheOracleOnEveryShapeAndFill) {
  unsigned seed = 1;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    for (const Fill fill : test::kAllFills) {
      if (HasFailure()) return;
      SCOPED_TRACE(test::describe(layout, fill));
      GuardedImage<std::uint8_t> grey(layout);
      test::fill_image(grey.view(), fill, seed++);
      const std::vector<std::uint8_t> before = pixels_of(grey.view());
      const int dead_zone = kDeadZones[seed % std::size(kDeadZones)];
      const Outcome outcome = run(GetParam().bit_planes, grey.view(), layout, dead_zone);
      const test::Census census = test::census_oracle(test::blur_oracle(grey.view()), dead_zone);
      ASSERT_EQ(outcome.codes, test::to_bytes(census.brighter)) << dead_zone;
      ASSERT_EQ(outcome.planes, test::planes_oracle(census)) << dead_zone;
      ASSERT_EQ(pixels_of(grey.view()), before);
      ASSERT_TRUE(grey.padding_is_untouched());
    }
  });
}

TEST_P(EachBitPlanes, EqualTheReferenceBitForBit) {
  unsigned seed = 1000;
  test::for_each_shape(kMaxWidth, [&](const GuardedLayout& layout) {
    if (HasFailure()) return;
    SCOPED_TRACE(test::describe(layout));
    GuardedImage<std::uint8_t> grey(layout);
    test::fill_image(grey.view(), Fill::kUniform, seed++);
    // Another stride and start than the source: nothing may assume that they agree.
    const GuardedLayout other = {.width = layout.width,
                                 .height = layout.height,
                                 .row_padding = layout.row_padding + 3,
                                 .distance_to_guard = 5};
    const int dead_zone = kDeadZones[seed % std::size(kDeadZones)];
    const Outcome outcome = run(GetParam().bit_planes, grey.view(), other, dead_zone);
    const Outcome expected = run(bit_planes_ref, grey.view(), layout, dead_zone);
    ASSERT_EQ(outcome.codes, expected.codes);
    ASSERT_EQ(outcome.planes, expected.planes);
  });
}

TEST_P(EachBitPlanes, AreTheSameInHighImages) {
  for (int height = 6; height <= 40; height += 3) {
    SCOPED_TRACE(height);
    GuardedImage<std::uint8_t> grey({.width = 37, .height = height, .row_padding = 3});
    test::fill_image(grey.view(), Fill::kUniform, static_cast<unsigned>(height));
    const test::Census census = test::census_oracle(test::blur_oracle(grey.view()), height);
    ASSERT_EQ(run_param(grey.view(), height).planes, test::planes_oracle(census));
  }
}

TEST_P(EachBitPlanes, ComputeTheCodesOrThePlanesAloneWhenTheOthersAreNotAskedFor) {
  for (const int width : {1, 3, 33, 64, 100}) {
    SCOPED_TRACE(width);
    const GuardedLayout layout = {.width = width, .height = 7, .row_padding = 2};
    GuardedImage<std::uint8_t> grey(layout);
    test::fill_image(grey.view(), Fill::kUniform, static_cast<unsigned>(width));
    const Outcome both = run(GetParam().bit_planes, grey.view(), layout);
    GuardedImage<std::uint8_t> codes(layout);
    GuardedImage<std::uint8_t> planes(test::resized(layout, width * kPlaneCount, 7));
    GuardedScratch scratch(width);
    GetParam().bit_planes(grey.view(), 0, codes.view(), scratch.span(), {});
    GetParam().bit_planes(grey.view(), 0, {}, scratch.span(), planes.view());
    EXPECT_EQ(pixels_of(codes.view()), both.codes);
    EXPECT_EQ(pixels_of(planes.view()), both.planes);
    EXPECT_TRUE(codes.padding_is_untouched());
    EXPECT_TRUE(planes.padding_is_untouched());
  }
}

TEST_P(EachBitPlanes, IgnoreEveryStrictlyIncreasingMapOfTheBlurredImage) {
  std::mt19937 random(7);
  for (unsigned trial = 0; trial < 50; ++trial) {
    GuardedImage<std::uint8_t> grey({.width = 71, .height = 9, .row_padding = 2});
    test::fill_image(grey.view(), Fill::kUniform, trial);
    test::GreyLevels mapped = test::blur_oracle(grey.view());
    std::vector<int> map(256, 0);
    for (std::size_t i = 1; i < map.size(); ++i) {
      map[i] = map[i - 1] + 1 + static_cast<int>(random() % 1000);
    }
    for (int& level : mapped.levels) level = map[static_cast<std::size_t>(level)];
    ASSERT_EQ(run_param(grey.view()).codes,
              test::to_bytes(test::census_oracle(mapped, 0).brighter));
  }
}

TEST_P(EachBitPlanes, IgnoreABrighterImageAndAnExactGain) {
  GuardedImage<std::uint8_t> plain({.width = 53, .height = 11});
  GuardedImage<std::uint8_t> mapped({.width = 53, .height = 11});
  for (const auto& [gain, offset] : {std::pair{1, 90}, {2, 0}, {2, 25}, {3, 7}}) {
    SCOPED_TRACE(gain);
    test::fill_image(plain.view(), Fill::kUniform, 5);
    for (int i = 0; i < 53 * 11; ++i) {
      std::uint8_t& level = plain.view().at(i % 53, i / 53);
      level = static_cast<std::uint8_t>(level % 5 * 16);  // sixteenths of the blur are whole
      mapped.view().at(i % 53, i / 53) = static_cast<std::uint8_t>(gain * level + offset);
    }
    const Outcome before = run_param(plain.view());
    const Outcome after = run_param(mapped.view());
    EXPECT_EQ(after.codes, before.codes);
    EXPECT_EQ(after.planes, before.planes);
    const int dead_zone = 7;
    EXPECT_EQ(run_param(mapped.view(), gain * dead_zone).planes,
              run_param(plain.view(), dead_zone).planes);
  }
}

// What a code of the neighbours at `bits` weighs.
int code_of(std::initializer_list<int> bits) {
  int code = 0;
  for (const int bit : bits) code |= 1 << bit;
  return code;
}

TEST_P(EachBitPlanes, NumberTheNeighboursInRasterOrder) {
  // A spot becomes a bump of 3×3 pixels; around it, only neighbours on the bump are brighter.
  GuardedImage<std::uint8_t> grey({.width = 9, .height = 9});
  test::fill_image(grey.view(), Fill::kConstant, 0);
  grey.view().at(4, 4) = 255;
  const std::vector<std::uint8_t> codes = run_param(grey.view()).codes;
  const struct {
    int x;
    int y;
    int code;
  } cases[] = {{2, 2, code_of({7})},
               {4, 2, code_of({5, 6, 7})},
               {6, 2, code_of({5})},
               {2, 4, code_of({2, 4, 7})},
               {4, 4, 0},
               {6, 4, code_of({0, 3, 5})},
               {2, 6, code_of({2})},
               {4, 6, code_of({0, 1, 2})},
               {6, 6, code_of({0})},
               {3, 3, code_of({4, 6, 7})},
               {0, 0, 0}};
  for (const auto& at : cases) {
    EXPECT_EQ(codes[static_cast<std::size_t>(at.y * 9 + at.x)], at.code) << at.x << " " << at.y;
  }
}

TEST_P(EachBitPlanes, AreUndecidedInAConstantImageIfThereIsADeadZone) {
  for (const unsigned level : {0U, 1U, 128U, 255U}) {
    GuardedImage<std::uint8_t> grey({.width = 40, .height = 12});
    test::fill_image(grey.view(), Fill::kConstant, level);
    for (const int dead_zone : {0, 1, 100}) {
      const Outcome outcome = run_param(grey.view(), dead_zone);
      EXPECT_EQ(outcome.codes, std::vector<std::uint8_t>(40 * 12, 0)) << level;
      EXPECT_EQ(outcome.planes,
                std::vector<std::uint8_t>(40 * 12 * kPlaneCount, dead_zone == 0 ? 0 : 128))
          << level << " " << dead_zone;
    }
  }
}

TEST_P(EachBitPlanes, KeepPlanesOfOneValueExactly) {
  constexpr int kWidth = 45;
  GuardedImage<std::uint8_t> ramp({.width = kWidth, .height = 10});
  for (int i = 0; i < kWidth * 10; ++i) {
    ramp.view().at(i % kWidth, i / kWidth) = static_cast<std::uint8_t>(5 * (i % kWidth));
  }
  const std::vector<std::uint8_t> planes = run_param(ramp.view(), 3).planes;
  for (int i = 0; i < kWidth * 10; ++i) {
    // The first column has no darker one beside it, the last no brighter one.
    if (i % kWidth < 4 || i % kWidth >= kWidth - 4) continue;
    constexpr int kOfNeighbours[kPlaneCount] = {0, 128, 255, 0, 255, 0, 128, 255};
    for (int c = 0; c < kPlaneCount; ++c) {
      ASSERT_EQ(planes[static_cast<std::size_t>(i * kPlaneCount + c)], kOfNeighbours[c])
          << "column " << i % kWidth << ", plane " << c;
    }
  }
}

TEST_P(EachBitPlanes, LieUpToThreeAboveTheBinomialFilterWithoutRounding) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    GuardedImage<std::uint8_t> grey({.width = 64, .height = 48});
    test::fill_image(grey.view(), Fill::kUniform, seed);
    const Outcome outcome = run_param(grey.view());
    const std::vector<double> exact =
        test::binomial_planes(test::census_oracle(test::blur_oracle(grey.view()), 0));
    for (std::size_t i = 0; i < exact.size(); ++i) {
      ASSERT_GE(outcome.planes[i], exact[i]);
      ASSERT_LE(outcome.planes[i], exact[i] + 3.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachBitPlanes, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

TEST(BitPlanes, BlurWithRoundingHalfUpBeforeTheyCompare) {
  // Beside a spot of 2, 4/16 round to 0 and stay equal; the spot itself, 8/16, becomes 1.
  GuardedImage<std::uint8_t> grey({.width = 5, .height = 5});
  test::fill_image(grey.view(), Fill::kConstant, 0);
  grey.view().at(2, 2) = 2;
  const Outcome outcome = run(bit_planes_ref, grey.view(), {.width = 5, .height = 5});
  EXPECT_EQ(outcome.codes[5 * 1 + 1], code_of({7}));  // the spot is to the lower right
  EXPECT_EQ(outcome.codes[5 * 2 + 1], code_of({4}));
  EXPECT_EQ(outcome.codes[0], 0);
}

TEST(BitPlanes, RefuseWhatDoesNotFit) {
  std::uint8_t grey[4] = {};
  std::uint8_t codes[4] = {};
  alignas(64) static std::uint8_t scratch[16384];
  std::uint8_t planes[32] = {};
  EXPECT_DEATH(bit_planes_ref({grey, 0, 1, 1}, 0, {}, scratch, {}), "at least one pixel");
  EXPECT_DEATH(bit_planes_ref({grey, 4, 1, 4}, 0, {codes, 2, 2, 2}, scratch, {}),
               "one census code a pixel");
  EXPECT_DEATH(bit_planes_ref({grey, 4, 1, 4}, 0, {}, scratch, {planes, 16, 2, 16}),
               "eight bytes of planes a pixel");
  EXPECT_DEATH(bit_planes_ref({grey, 4, 1, 4}, 256, {}, scratch, {}), "a grey level");
  const std::size_t needed = bit_planes_scratch_bytes(4);
  ASSERT_LE(needed, sizeof(scratch));
  EXPECT_DEATH(bit_planes_ref({grey, 4, 1, 4}, 0, {}, {scratch, needed - 1}, {planes, 32, 1, 32}),
               "scratch is too small");
}

}  // namespace
}  // namespace darkling
