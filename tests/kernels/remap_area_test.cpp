// SPDX-License-Identifier: Apache-2.0
#include "kernels/remap_area.h"

#include <algorithm>
#include <cstdlib>

#include <opencv2/imgproc.hpp>

#include "support/pixels.h"
#include "support/random.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;
using test::GuardedLayout;
using test::pixels_of;

// A map with its memory. Entries begin as zero: the top-left box.
struct OwnedMap {
  OwnedMap(int width, int height, int taps)
      : entries(static_cast<std::size_t>(width * height)),
        weights(std::size_t{kAreaPhases} * kMaxAreaTaps, 0) {
    map.entries = {entries.data(), width, height, width};
    map.weights = weights.data();
    map.taps = taps;
  }

  std::vector<AreaMapEntry> entries;
  std::vector<std::uint8_t> weights;
  AreaMap map;
};

// Entries and weights without any pattern; every phase sums to 256, the far taps included.
OwnedMap random_map(int width, int height, const ImageView<const std::uint8_t>& src, int taps,
                    std::uint64_t seed) {
  test::Random random(seed);
  OwnedMap owned(width, height, taps);
  for (int phase = 0; phase < kAreaPhases; ++phase) {
    std::uint8_t* weights = &owned.weights[phase * kMaxAreaTaps];
    int left = 256;
    for (int i = 0; i + 1 < taps; ++i) {
      // A byte holds no 256: the first tap takes 1 at least.
      weights[i] = static_cast<std::uint8_t>(random.integer(i == 0 ? 1 : 0, std::min(left, 255)));
      left -= weights[i];
    }
    weights[taps - 1] = static_cast<std::uint8_t>(left);
  }
  for (AreaMapEntry& entry : owned.entries) {
    entry.x = static_cast<std::uint16_t>(random.integer(0, src.width - taps));
    entry.y = static_cast<std::uint16_t>(random.integer(0, src.height - taps));
    entry.phase_x = static_cast<std::uint16_t>(random.integer(0, kAreaPhases - 1));
    entry.phase_y = static_cast<std::uint16_t>(random.integer(0, kAreaPhases - 1));
  }
  // The corners: where a tap too many leaves the image.
  owned.entries.front().x = owned.entries.front().y = 0;
  owned.entries.back().x = static_cast<std::uint16_t>(src.width - taps);
  owned.entries.back().y = static_cast<std::uint16_t>(src.height - taps);
  return owned;
}

// The sum of the contract in doubles: exact, as its terms are whole 1/65536.
std::vector<std::uint8_t> remap_oracle(const AreaMap& map,
                                       const ImageView<const std::uint8_t>& src) {
  std::vector<std::uint8_t> out;
  for (const AreaMapEntry& e : pixels_of(map.entries)) {
    double sum = 0.0;
    for (int j = 0; j < map.taps; ++j) {
      for (int i = 0; i < map.taps; ++i) {
        sum += map.weights[e.phase_x * kMaxAreaTaps + i] / 256.0 *
               (map.weights[e.phase_y * kMaxAreaTaps + j] / 256.0) * src.at(e.x + i, e.y + j);
      }
    }
    out.push_back(static_cast<std::uint8_t>(test::round_half_up(sum)));
  }
  return out;
}

class EachRemapArea : public ::testing::TestWithParam<KernelTable> {};

TEST_P(EachRemapArea, EqualsTheOracleAndTheReferenceOnEveryMap) {
  unsigned seed = 1;
  for (int taps = 2; taps <= kMaxAreaTaps; ++taps) {
    for (const Fill fill : test::kAllFills) {
      // 0: the box just fits, at the right border; 40: whole vectors do too, of most pixels.
      for (const int slack_px : {0, 1, 9, 40}) {
        const GuardedLayout source = {.width = taps + slack_px,
                                      .height = taps + slack_px / 2,
                                      .row_padding = taps % 3,
                                      .distance_to_guard = taps % 2};
        const GuardedLayout target = {.width = 16 + taps, .height = 4, .row_padding = 1};
        SCOPED_TRACE(test::describe(source, fill) + ", taps " + std::to_string(taps));
        GuardedImage<std::uint8_t> src(source);
        GuardedImage<std::uint8_t> dst(target);
        GuardedImage<std::uint8_t> expected(target);
        test::fill_image(src.view(), fill, seed);
        const OwnedMap owned = random_map(target.width, target.height, src.view(), taps, seed++);
        GetParam().remap_area(owned.map, src.view(), dst.view());
        remap_area_ref(owned.map, src.view(), expected.view());
        ASSERT_EQ(pixels_of(dst.view()), remap_oracle(owned.map, src.view()));
        ASSERT_EQ(pixels_of(dst.view()), pixels_of(expected.view()));
        ASSERT_TRUE(src.padding_is_untouched());
        ASSERT_TRUE(dst.padding_is_untouched());
      }
    }
  }
}

TEST_P(EachRemapArea, EqualsOpenCvsAreaMeanAtPowersOfTwo) {
  for (const int factor : {2, 4, 8, 16}) {
    SCOPED_TRACE(factor);
    constexpr int kWidth = 21;
    constexpr int kHeight = 5;
    const int taps = factor + 1;
    GuardedImage<std::uint8_t> src(
        {.width = kWidth * factor + 1, .height = kHeight * factor + 1, .row_padding = 5});
    GuardedImage<std::uint8_t> dst({.width = kWidth, .height = kHeight});
    test::fill_image(src.view(), Fill::kUniform, static_cast<unsigned>(factor));
    OwnedMap owned(kWidth, kHeight, taps);
    std::fill_n(owned.weights.begin(), factor, static_cast<std::uint8_t>(256 / factor));
    for (int i = 0; i < kWidth * kHeight; ++i) {
      owned.entries[i].x = static_cast<std::uint16_t>(i % kWidth * factor);
      owned.entries[i].y = static_cast<std::uint16_t>(i / kWidth * factor);
    }
    GetParam().remap_area(owned.map, src.view(), dst.view());

    const cv::Mat whole(src.view().height, src.view().width, CV_8UC1, src.view().data,
                        static_cast<std::size_t>(src.view().stride));
    cv::Mat means;
    whole(cv::Rect(0, 0, kWidth * factor, kHeight * factor)).convertTo(means, CV_64F);
    cv::resize(means, means, {kWidth, kHeight}, 0.0, 0.0, cv::INTER_AREA);
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const int x = i % kWidth;
      const int y = i / kWidth;
      ASSERT_EQ(dst.view().at(x, y), test::round_half_up(means.at<double>(y, x))) << x << " " << y;
    }
  }
}

// Where one pixel has all the weight, 1/256 of it goes to the next in either direction.
TEST_P(EachRemapArea, GivesTheImageBackButForTheSpillBesideEdgesOfHalfTheRange) {
  constexpr int kWidth = 45;
  constexpr int kHeight = 13;
  for (const Fill fill : test::kAllFills) {
    SCOPED_TRACE(test::name_of(fill));
    GuardedImage<std::uint8_t> src({.width = kWidth + 1, .height = kHeight + 1});
    GuardedImage<std::uint8_t> dst({.width = kWidth, .height = kHeight});
    test::fill_image(src.view(), fill, 6);
    OwnedMap owned(kWidth, kHeight, 2);
    owned.weights[0] = 255;
    owned.weights[1] = 1;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      owned.entries[i].x = static_cast<std::uint16_t>(i % kWidth);
      owned.entries[i].y = static_cast<std::uint16_t>(i / kWidth);
    }
    GetParam().remap_area(owned.map, src.view(), dst.view());
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const int x = i % kWidth;
      const int y = i / kWidth;
      const int here = src.view().at(x, y);
      const int edge =
          std::abs(src.view().at(x + 1, y) - here) + std::abs(src.view().at(x, y + 1) - here);
      // 1/256 of the edge, rounded; beyond 383 it is an edge in both directions.
      const int bound = edge < 127 ? 0 : edge < 382 ? 1 : 2;
      ASSERT_NEAR(dst.view().at(x, y), here, bound) << x << " " << y;
    }
  }
}

TEST_P(EachRemapArea, KeepsAConstantImageWhateverTheMap) {
  for (int taps = 2; taps <= kMaxAreaTaps; taps += 5) {
    for (const unsigned level : {0U, 1U, 127U, 128U, 255U}) {
      GuardedImage<std::uint8_t> src({.width = taps + 30, .height = taps + 2});
      GuardedImage<std::uint8_t> dst({.width = 27, .height = 3});
      test::fill_image(src.view(), Fill::kConstant, level);
      const OwnedMap owned = random_map(27, 3, src.view(), taps, level);
      GetParam().remap_area(owned.map, src.view(), dst.view());
      ASSERT_EQ(pixels_of(dst.view()),
                std::vector<std::uint8_t>(27 * 3, static_cast<std::uint8_t>(level)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachRemapArea, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

}  // namespace
}  // namespace darkling
