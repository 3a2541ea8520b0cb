// SPDX-License-Identifier: Apache-2.0
#include "kernels/semi_global.h"
#include "support/pixels.h"

namespace darkling {
namespace {

using test::Fill;
using test::GuardedImage;

constexpr int kMaxWidth = 3 * 32 + 4;  // px, past three of the widest vectors

class EachHammingRow : public ::testing::TestWithParam<KernelTable> {
 protected:
  static void check(int width, Fill fill) {
    SCOPED_TRACE(testing::Message() << width << " px, fill " << test::name_of(fill));
    GuardedImage<std::uint8_t> left({.width = width, .height = 1});
    GuardedImage<std::uint8_t> right({.width = width, .height = 1});
    GuardedImage<std::uint8_t> reversed({.width = width + kDisparities, .height = 1});
    GuardedImage<std::uint8_t> cost({.width = width * kDisparities, .height = 1});
    GuardedImage<std::uint8_t> expected({.width = width * kDisparities, .height = 1});
    test::fill_image(left.view(), fill, static_cast<unsigned>(width));
    test::fill_image(right.view(), fill, static_cast<unsigned>(width + 500));
    test::fill_image(reversed.view(), Fill::kUniform, 1);  // what is behind the row has no say
    for (int k = 0; k < width; ++k) reversed.view().at(k, 0) = right.view().at(width - 1 - k, 0);
    GetParam().hamming_row(left.view().data, reversed.view().data, width, cost.view().data);
    hamming_row_ref(left.view().data, reversed.view().data, width, expected.view().data);
    for (int i = 0; i < width * kDisparities; ++i) {
      const int x = i / kDisparities;
      const int d = i % kDisparities;
      int bits = x < d ? 8 : 0;
      for (int c = 0; c < 8 && x >= d; ++c) {
        bits += (left.view().at(x, 0) >> c & 1) != (right.view().at(x - d, 0) >> c & 1) ? 1 : 0;
      }
      ASSERT_EQ(cost.view().at(i, 0), bits) << x << " " << d;
    }
    ASSERT_EQ(test::pixels_of(cost.view()), test::pixels_of(expected.view()));
    ASSERT_TRUE(cost.padding_is_untouched());
  }
};

TEST_P(EachHammingRow, CountsTheBitsThatDifferOnEveryWidthAndFill) {
  for (int width = 1; width <= kMaxWidth && !HasFailure(); ++width) {
    for (const Fill fill : test::kAllFills) check(width, fill);
  }
}

TEST_P(EachHammingRow, CountsEveryDifferenceOfTwoCodes) {
  constexpr int kWidth = kDisparities;  // the last pixel sees all others
  GuardedImage<std::uint8_t> left({.width = kWidth, .height = 1});
  GuardedImage<std::uint8_t> reversed({.width = kWidth + kDisparities, .height = 1});
  GuardedImage<std::uint8_t> cost({.width = kWidth * kDisparities, .height = 1});
  for (int first = 0; first < 256; first += kDisparities) {
    test::fill_image(left.view(), Fill::kConstant, 0);
    test::fill_image(reversed.view(), Fill::kConstant, 0);
    for (int k = 0; k < kWidth; ++k) {
      reversed.view().at(k, 0) = static_cast<std::uint8_t>(first + k);
    }
    GetParam().hamming_row(left.view().data, reversed.view().data, kWidth, cost.view().data);
    for (int d = 0; d < kDisparities; ++d) {
      int bits = 0;
      for (int rest = first + d; rest > 0; rest /= 2) bits += rest % 2;
      ASSERT_EQ(cost.view().at((kWidth - 1) * kDisparities + d, 0), bits) << first + d;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachHammingRow, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

}  // namespace
}  // namespace darkling
