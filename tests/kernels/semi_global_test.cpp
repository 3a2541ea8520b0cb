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

constexpr int D = kDisparities;
constexpr int kMaxWidth = 70;  // px, past two rows of disparities

// A number for every pixel and disparity of a small image.
struct Volume {
  int width = 0;
  int height = 0;
  std::vector<int> values = {};

  [[nodiscard]] bool holds(int x, int y) const {
    return x >= 0 && x < width && y >= 0 && y < height;
  }
  [[nodiscard]] int at(int x, int y, int d) const {
    return values[static_cast<std::size_t>((y * width + x) * D + d)];
  }
};

// Hamming distances: any, or only the least and the greatest.
enum class Distances { kAny, kExtremes };

Volume random_hamming(int width, int height, Distances distances, Random& random) {
  Volume volume{width, height};
  for (int i = 0; i < width * height * D; ++i) {
    const int bits = random.integer(0, 8);
    volume.values.push_back(distances == Distances::kAny ? bits : bits / 5 * 8);
  }
  return volume;
}

// Sums over 3×3 pixels, the nearest standing in beyond the border.
Volume window_oracle(const Volume& hamming) {
  Volume costs{hamming.width, hamming.height};
  for (int i = 0; i < hamming.width * hamming.height * D; ++i) {
    const int x = i / D % hamming.width;
    const int y = i / D / hamming.width;
    int sum = 0;
    for (int k = 0; k < 9; ++k) {
      sum += hamming.at(std::clamp(x + k % 3 - 1, 0, hamming.width - 1),
                        std::clamp(y + k / 3 - 1, 0, hamming.height - 1), i % D);
    }
    costs.values.push_back(sum);
  }
  return costs;
}

// One path of eq. (13) by recursion: L(p, d) = C(p, d) + min(L(q, d), L(q, d ± 1) + P1,
// min_k L(q, k) + P2) - min_k L(q, k), q the pixel before p; C(p, d) alone where q is outside.
class PathOracle {
 public:
  PathOracle(const Volume& costs, SemiGlobalPenalties penalties, int dx, int dy)
      : volume_(costs), penalties_(penalties), dx_(dx), dy_(dy) {}

  const std::vector<int>& costs_at(int x, int y) {
    const auto found = memory_.find({x, y});
    if (found != memory_.end()) return found->second;
    std::vector<int> path;
    for (int d = 0; d < D; ++d) path.push_back(volume_.at(x, y, d));
    if (volume_.holds(x - dx_, y - dy_)) {
      const std::vector<int> before = costs_at(x - dx_, y - dy_);
      const int least = *std::min_element(before.begin(), before.end());
      for (int d = 0; d < D; ++d) {
        int best = std::min(before[d], least + penalties_.large_step);
        if (d > 0) best = std::min(best, before[d - 1] + penalties_.small_step);
        if (d + 1 < D) best = std::min(best, before[d + 1] + penalties_.small_step);
        path[d] += best - least;
      }
    }
    return memory_[{x, y}] = path;
  }

 private:
  const Volume& volume_;
  SemiGlobalPenalties penalties_;
  int dx_;
  int dy_;
  std::map<std::pair<int, int>, std::vector<int>> memory_;
};

// The sum of the five paths for the whole image.
Volume sums_oracle(const Volume& costs, SemiGlobalPenalties penalties) {
  Volume sums{costs.width, costs.height, std::vector<int>(costs.values.size(), 0)};
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {1, 1}, {0, 1}, {-1, 1}}) {
    PathOracle path(costs, penalties, dx, dy);
    for (int i = 0; i < costs.width * costs.height; ++i) {
      const std::vector<int>& along = path.costs_at(i % costs.width, i / costs.width);
      for (int d = 0; d < D; ++d) sums.values[static_cast<std::size_t>(i * D + d)] += along[d];
    }
  }
  return sums;
}

// Of the pixel at column x of one eye: the least sum and its disparity, the smaller of equal ones.
// The other eye's pixel must lie in its image, `towards` being -1 for the left eye and 1 for the
// right one, whose costs stand at the left pixel.
int winner_oracle(const Volume& sums, int x, int y, int towards) {
  std::pair<int, int> best = {1 << 20, 0};
  for (int d = 0; d < D; ++d) {
    if (!sums.holds(x + towards * d, y)) continue;
    const int left_x = towards < 0 ? x : x + d;
    best = std::min(best, {sums.at(left_x, y, d), d});
  }
  return best.first * D + best.second;
}

// What a whole image gives, row by row.
struct Outcome {
  std::vector<int> costs;
  std::vector<int> sums;
  std::vector<int> left_winners;
  std::vector<int> right_winners;  // in the order of columns
  std::vector<int> behind;         // what else is written behind the right winners

  bool operator==(const Outcome&) const = default;
};

Outcome outcome_oracle(const Volume& hamming, SemiGlobalPenalties penalties) {
  const Volume costs = window_oracle(hamming);
  const Volume sums = sums_oracle(costs, penalties);
  Outcome outcome = {costs.values, sums.values, {}, {}, {}};
  for (int i = 0; i < hamming.width * hamming.height; ++i) {
    const int x = i % hamming.width;
    const int y = i / hamming.width;
    outcome.left_winners.push_back(winner_oracle(sums, x, y, -1));
    outcome.right_winners.push_back(winner_oracle(sums, x, y, 1));
  }
  return outcome;
}

// The kernel's memory of paths, every buffer between guards.
class GuardedPaths {
 public:
  explicit GuardedPaths(int width) {
    rows_.width = width;
    for (int i = 0; i < 6; ++i) {
      costs_.push_back(std::make_unique<GuardedImage<std::uint8_t>>(
          test::GuardedLayout{.width = path_costs_bytes(width), .height = 1}));
      minima_.push_back(std::make_unique<GuardedImage<std::uint8_t>>(
          test::GuardedLayout{.width = path_minima_bytes(width), .height = 1}));
      rows_.costs[i / 2][i % 2] = costs_.back()->view().data;
      rows_.minima[i / 2][i % 2] = minima_.back()->view().data;
    }
  }

  [[nodiscard]] PathRows& rows() { return rows_; }
  [[nodiscard]] bool padding_is_untouched() const {
    const auto is_untouched = [](const auto& image) -> bool {
      return static_cast<bool>(image->padding_is_untouched());
    };
    return std::all_of(costs_.begin(), costs_.end(), is_untouched) &&
           std::all_of(minima_.begin(), minima_.end(), is_untouched);
  }

 private:
  std::vector<std::unique_ptr<GuardedImage<std::uint8_t>>> costs_;
  std::vector<std::unique_ptr<GuardedImage<std::uint8_t>>> minima_;
  PathRows rows_;
};

// Runs row `y` of the image through the kernel, all memory guarded.
void match_row(SemiGlobalRowFn* semi_global_row, const Volume& hamming, int y,
               SemiGlobalPenalties penalties, PathRows& paths, Outcome& out) {
  const int width = hamming.width;
  std::vector<std::unique_ptr<GuardedImage<std::uint8_t>>> rows;
  const std::uint8_t* pointers[3] = {};
  for (int j = -1; j <= 1; ++j) {
    rows.push_back(std::make_unique<GuardedImage<std::uint8_t>>(
        test::GuardedLayout{.width = width * D, .height = 1}));
    for (int i = 0; i < width * D; ++i) {
      const int row = std::clamp(y + j, 0, hamming.height - 1);
      rows.back()->view().at(i, 0) = static_cast<std::uint8_t>(hamming.at(i / D, row, i % D));
    }
    pointers[j + 1] = rows.back()->view().data;
  }
  GuardedImage<std::uint8_t> cost({.width = width * D, .height = 1});
  GuardedImage<std::uint16_t> sum({.width = width * D, .height = 1});
  GuardedImage<std::uint16_t> left({.width = width, .height = 1});
  GuardedImage<std::uint16_t> right({.width = width + D, .height = 1});
  semi_global_row(pointers, penalties, paths,
                  {cost.view().data, sum.view().data, left.view().data, right.view().data});
  EXPECT_TRUE(cost.padding_is_untouched());
  EXPECT_TRUE(sum.padding_is_untouched());
  EXPECT_TRUE(left.padding_is_untouched());
  EXPECT_TRUE(right.padding_is_untouched());
  for (const int value : test::pixels_of(cost.view())) out.costs.push_back(value);
  for (const int value : test::pixels_of(sum.view())) out.sums.push_back(value);
  for (const int value : test::pixels_of(left.view())) out.left_winners.push_back(value);
  for (int x = 0; x < width; ++x) out.right_winners.push_back(right.view().at(width - 1 - x, 0));
  for (int k = width; k < width + D; ++k) out.behind.push_back(right.view().at(k, 0));
}

Outcome match_image(SemiGlobalRowFn* semi_global_row, const Volume& hamming,
                    SemiGlobalPenalties penalties, GuardedPaths& paths) {
  Outcome outcome;
  reset_path_rows(paths.rows());
  for (int y = 0; y < hamming.height; ++y) {
    match_row(semi_global_row, hamming, y, penalties, paths.rows(), outcome);
  }
  EXPECT_TRUE(paths.padding_is_untouched());
  return outcome;
}

class EachSemiGlobal : public ::testing::TestWithParam<KernelTable> {};

TEST_P(EachSemiGlobal, EqualsTheRecursionAndTheReferenceOnEveryWidth) {
  Random random(1);
  for (const SemiGlobalPenalties penalties :
       {SemiGlobalPenalties{8, 32}, SemiGlobalPenalties{0, 0}, SemiGlobalPenalties{3, 100},
        SemiGlobalPenalties{183, 183}}) {
    for (int width = 1; width <= kMaxWidth; ++width) {
      SCOPED_TRACE(testing::Message() << width << " px, P2 " << int{penalties.large_step});
      const auto distances = width % 2 == 0 ? Distances::kAny : Distances::kExtremes;
      const Volume hamming = random_hamming(width, 4, distances, random);
      GuardedPaths paths(width);
      const Outcome found = match_image(GetParam().semi_global_row, hamming, penalties, paths);
      const Outcome expected = outcome_oracle(hamming, penalties);
      ASSERT_EQ(found.costs, expected.costs);
      ASSERT_EQ(found.sums, expected.sums);
      ASSERT_EQ(found.left_winners, expected.left_winners);
      ASSERT_EQ(found.right_winners, expected.right_winners);
      ASSERT_EQ(match_image(semi_global_row_ref, hamming, penalties, paths), found);
    }
  }
}

// All bits differ but at one disparity, which changes along the row and from row to row: the paths
// reach 72 + 183 where both are greatest.
TEST_P(EachSemiGlobal, FitsItsBytesAtTheGreatestPenalty) {
  constexpr SemiGlobalPenalties kGreatest = {183, 183};
  constexpr int kWidth = 48;
  Volume hamming{kWidth, 9};
  for (int i = 0; i < kWidth * 9; ++i) {
    const int matching = (i % kWidth / 6 * 5 + i / kWidth / 4 * 11) % D;
    for (int d = 0; d < D; ++d) hamming.values.push_back(d == matching ? 0 : 8);
  }
  GuardedPaths paths(kWidth);
  const Outcome found = match_image(GetParam().semi_global_row, hamming, kGreatest, paths);
  const Outcome expected = outcome_oracle(hamming, kGreatest);
  EXPECT_EQ(*std::max_element(expected.sums.begin(), expected.sums.end()), 5 * 255);
  EXPECT_EQ(found.sums, expected.sums);
  EXPECT_EQ(found.left_winners, expected.left_winners);
  EXPECT_EQ(found.right_winners, expected.right_winners);
}

TEST_P(EachSemiGlobal, ForgetsTheImageBeforeOnReset) {
  Random random(2);
  const Volume first = random_hamming(7, 3, Distances::kAny, random);
  const Volume second = random_hamming(7, 3, Distances::kAny, random);
  GuardedPaths paths(7);
  const Outcome fresh = match_image(GetParam().semi_global_row, second, {8, 32}, paths);
  (void)match_image(GetParam().semi_global_row, first, {8, 32}, paths);
  EXPECT_EQ(match_image(GetParam().semi_global_row, second, {8, 32}, paths), fresh);
}

TEST_P(EachSemiGlobal, PrefersTheSmallestOfEqualDisparities) {
  const Volume flat{50, 3, std::vector<int>(50 * 3 * D, 4)};
  GuardedPaths paths(50);
  const Outcome outcome = match_image(GetParam().semi_global_row, flat, {8, 32}, paths);
  for (const int winner : outcome.left_winners) ASSERT_EQ(winner % D, 0);
  for (const int winner : outcome.right_winners) ASSERT_EQ(winner % D, 0);
}

TEST_P(EachSemiGlobal, ChoosesTheLeastWindowSumWithoutPenalties) {
  Random random(3);
  const Volume hamming = random_hamming(61, 5, Distances::kAny, random);
  GuardedPaths paths(61);
  const Outcome outcome = match_image(GetParam().semi_global_row, hamming, {0, 0}, paths);
  const Volume costs = window_oracle(hamming);
  for (int i = 0; i < 61 * 5; ++i) {
    int best = 0;
    for (int d = 1; d <= std::min(i % 61, D - 1); ++d) {
      if (costs.at(i % 61, i / 61, d) < costs.at(i % 61, i / 61, best)) best = d;
    }
    // The five paths each cost what the window does.
    const int sum = 5 * costs.at(i % 61, i / 61, best);
    ASSERT_EQ(outcome.left_winners[static_cast<std::size_t>(i)], sum * D + best) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EachSemiGlobal, ::testing::ValuesIn(test::available_tables()),
                         test::table_name);

}  // namespace
}  // namespace darkling
