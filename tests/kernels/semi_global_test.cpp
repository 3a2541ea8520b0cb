// SPDX-License-Identifier: Apache-2.0
#include "kernels/semi_global.h"

#include <algorithm>
#include <map>
#include <memory>

#include "support/pixels.h"
#include "support/random.h"

namespace darkling {
namespace {

using test::GuardedImage;
using test::Random;

// A cost for every pixel and disparity of a small image.
struct CostVolume {
  int width = 0;
  int height = 0;
  int disparities = 0;
  std::vector<int> costs;

  [[nodiscard]] bool holds(int x, int y) const {
    return x >= 0 && x < width && y >= 0 && y < height;
  }
  [[nodiscard]] int at(int x, int y, int d) const {
    return costs[static_cast<std::size_t>((y * width + x) * disparities + d)];
  }
};

CostVolume random_volume(int width, int height, int disparities, int max_cost, Random& random) {
  CostVolume volume{width, height, disparities, {}};
  volume.costs.resize(static_cast<std::size_t>(width * height * disparities));
  for (int& cost : volume.costs) cost = random.integer(0, max_cost);
  return volume;
}

// One path of eq. (13) by recursion: L(p, d) = C(p, d) + min(L(q, d), L(q, d ± 1) + P1,
// min_k L(q, k) + P2) - min_k L(q, k), q the pixel before p; C(p, d) alone where q is outside.
class PathOracle {
 public:
  PathOracle(const CostVolume& volume, SemiGlobalPenalties penalties, int dx, int dy)
      : volume_(volume), penalties_(penalties), dx_(dx), dy_(dy) {}

  const std::vector<int>& costs_at(int x, int y) {
    const auto found = memory_.find({x, y});
    if (found != memory_.end()) return found->second;
    std::vector<int> path;
    for (int d = 0; d < volume_.disparities; ++d) path.push_back(volume_.at(x, y, d));
    if (volume_.holds(x - dx_, y - dy_)) {
      const std::vector<int> before = costs_at(x - dx_, y - dy_);
      const int least = *std::min_element(before.begin(), before.end());
      for (int d = 0; d < volume_.disparities; ++d) {
        int best = std::min(before[d], least + penalties_.large_step);
        if (d > 0) best = std::min(best, before[d - 1] + penalties_.small_step);
        if (d + 1 < volume_.disparities) {
          best = std::min(best, before[d + 1] + penalties_.small_step);
        }
        path[d] += best - least;
      }
    }
    return memory_[{x, y}] = path;
  }

 private:
  const CostVolume& volume_;
  SemiGlobalPenalties penalties_;
  int dx_;
  int dy_;
  std::map<std::pair<int, int>, std::vector<int>> memory_;
};

// The sum of the five paths for the whole image, disparity-fastest.
std::vector<int> sums_oracle(const CostVolume& volume, SemiGlobalPenalties penalties) {
  std::vector<int> sums(volume.costs.size(), 0);
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {1, 1}, {0, 1}, {-1, 1}}) {
    PathOracle path(volume, penalties, dx, dy);
    for (int i = 0; i < volume.width * volume.height; ++i) {
      const std::vector<int>& costs = path.costs_at(i % volume.width, i / volume.width);
      for (int d = 0; d < volume.disparities; ++d) sums[i * volume.disparities + d] += costs[d];
    }
  }
  return sums;
}

// The kernel's memory, every buffer between guards.
class GuardedPaths {
 public:
  GuardedPaths(int width, int disparities)
      : along_({.width = path_along_bytes(disparities), .height = 1}) {
    rows_.width = width;
    rows_.disparities = disparities;
    for (int i = 0; i < 6; ++i) {
      costs_.push_back(std::make_unique<GuardedImage<std::uint8_t>>(
          test::GuardedLayout{.width = path_costs_bytes(width, disparities), .height = 1}));
      minima_.push_back(std::make_unique<GuardedImage<std::uint8_t>>(
          test::GuardedLayout{.width = path_minima_bytes(width), .height = 1}));
      rows_.costs[i / 2][i % 2] = costs_.back()->view().data;
      rows_.minima[i / 2][i % 2] = minima_.back()->view().data;
    }
    rows_.along = along_.view().data;
  }

  [[nodiscard]] PathRows& rows() { return rows_; }
  [[nodiscard]] bool padding_is_untouched() const {
    const auto is_untouched = [](const auto& image) -> bool {
      return static_cast<bool>(image->padding_is_untouched());
    };
    return std::all_of(costs_.begin(), costs_.end(), is_untouched) &&
           std::all_of(minima_.begin(), minima_.end(), is_untouched) &&
           along_.padding_is_untouched();
  }

 private:
  std::vector<std::unique_ptr<GuardedImage<std::uint8_t>>> costs_;
  std::vector<std::unique_ptr<GuardedImage<std::uint8_t>>> minima_;
  GuardedImage<std::uint8_t> along_;
  PathRows rows_;
};

// All sums of an image, row by row through the kernel.
std::vector<int> aggregate(SemiGlobalRowFn* semi_global_row, const CostVolume& volume,
                           SemiGlobalPenalties penalties, GuardedPaths& paths) {
  const int row_size = volume.width * volume.disparities;
  std::vector<int> sums;
  reset_path_rows(paths.rows());
  for (int y = 0; y < volume.height; ++y) {
    GuardedImage<std::uint8_t> cost({.width = row_size, .height = 1});
    GuardedImage<std::uint16_t> sum({.width = row_size, .height = 1});
    for (int i = 0; i < row_size; ++i) {
      cost.view().at(i, 0) =
          static_cast<std::uint8_t>(volume.costs[static_cast<std::size_t>(y * row_size + i)]);
    }
    semi_global_row({cost.view().data, static_cast<std::size_t>(row_size)}, penalties, paths.rows(),
                    {sum.view().data, static_cast<std::size_t>(row_size)});
    EXPECT_TRUE(cost.padding_is_untouched());
    EXPECT_TRUE(sum.padding_is_untouched());
    for (const std::uint16_t value : test::pixels_of(sum.view())) sums.push_back(value);
  }
  EXPECT_TRUE(paths.padding_is_untouched());
  return sums;
}

class EachSemiGlobal : public ::testing::TestWithParam<KernelTable> {};

TEST_P(EachSemiGlobal, EqualsTheRecursionOnEveryWidth) {
  Random random(1);
  for (const SemiGlobalPenalties penalties :
       {SemiGlobalPenalties{8, 32}, SemiGlobalPenalties{0, 0}, SemiGlobalPenalties{3, 100}}) {
    for (int width = 1; width <= 9; ++width) {
      for (const int disparities : {16, 48}) {
        SCOPED_TRACE(testing::Message() << width << " px, " << disparities << " disparities, P2 "
                                        << int{penalties.large_step});
        const int max_cost = width % 2 == 0 ? 72 : 255 - penalties.large_step;
        const CostVolume volume = random_volume(width, 4, disparities, max_cost, random);
        GuardedPaths paths(width, disparities);
        const std::vector<int> sums =
            aggregate(GetParam().semi_global_row, volume, penalties, paths);
        ASSERT_EQ(sums, sums_oracle(volume, penalties));
        ASSERT_EQ(aggregate(semi_global_row_ref, volume, penalties, paths), sums);
      }
    }
  }
}

TEST_P(EachSemiGlobal, ForgetsTheImageBeforeOnReset) {
  Random random(2);
  const CostVolume first = random_volume(7, 3, 16, 72, random);
  const CostVolume second = random_volume(7, 3, 16, 72, random);
  GuardedPaths paths(7, 16);
  const std::vector<int> fresh = aggregate(GetParam().semi_global_row, second, {8, 32}, paths);
  (void)aggregate(GetParam().semi_global_row, first, {8, 32}, paths);
  EXPECT_EQ(aggregate(GetParam().semi_global_row, second, {8, 32}, paths), fresh);
}

TEST_P(EachSemiGlobal, HammingRowCountsTheBitsThatDiffer) {
  Random random(3);
  for (int width = 1; width <= 3 * 32 + 4; ++width) {
    for (const int disparities : {16, 64}) {
      SCOPED_TRACE(testing::Message() << width << " px, " << disparities << " disparities");
      GuardedImage<std::uint8_t> left({.width = width, .height = 1});
      GuardedImage<std::uint8_t> right(
          {.width = width, .height = 1, .guard = test::GuardSide::kBeforeFirstRow});
      GuardedImage<std::uint8_t> cost({.width = width * disparities, .height = 1});
      test::fill_image(left.view(), test::Fill::kUniform, static_cast<unsigned>(width));
      test::fill_image(right.view(), test::Fill::kUniform, static_cast<unsigned>(width + 500));
      const auto span = [](auto view) { return std::span(view.data, std::size_t(view.width)); };
      GetParam().hamming_row(span(left.view()), span(right.view()), disparities, span(cost.view()));
      for (int x = 0; x < width; ++x) {
        for (int d = 0; d < disparities; ++d) {
          int bits = x < d ? 8 : 0;
          for (int c = 0; c < 8 && x >= d; ++c) {
            bits += (left.view().at(x, 0) >> c & 1) != (right.view().at(x - d, 0) >> c & 1) ? 1 : 0;
          }
          ASSERT_EQ(cost.view().at(x * disparities + d, 0), bits) << x << " " << d;
        }
      }
      ASSERT_TRUE(cost.padding_is_untouched());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachSemiGlobal, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

}  // namespace
}  // namespace darkling
