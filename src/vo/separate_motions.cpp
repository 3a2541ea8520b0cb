// SPDX-License-Identifier: Apache-2.0
#include "vo/separate_motions.h"

#include <algorithm>

namespace darkling {

namespace {

// Squares of descriptor distances, root mean square over the planes in 0…255: at most this far a
// point lies on what it is of, and from there on it does not. Unrelated places are about 110 apart.
constexpr float kMaxFitSquares = kPlaneCount * 40.0f * 40.0f;
constexpr float kMinMisfitSquares = kPlaneCount * 60.0f * 60.0f;
// A point goes with a motion that leaves it less than half the squares that the other one does.
// Noise is in both, so that it makes a point undecided and not wrong.
constexpr float kClearlyBetter = 0.5f;
// How much nearer than the mean of its level a point is left out of the search for what lies
// behind. Tried at 0.8, 1 and 1.4, too: below, a quarry's distant half hardly tells a translation;
// above, a board a metre away stays in.
constexpr float kNear = 1.2f;
// Of the points in the image: so many go with a motion that is one …
constexpr double kMinSupport = 0.1;
// … and at most so many times as many with the first one: in a quarry's steady light, a seventh of
// the points agree on another motion than the rest, by chance and by clouds.
constexpr int kMaxImbalance = 3;

// Translations of two motions differ by so many px of the image of what goes with the second one.
// In a quarry, sky and hills often agree on another rotation than the ground, with translations
// that are 0.1 px apart there, mostly, and 0.9 at most; behind a board they were 1.7 and more.
constexpr double kMinDifferencePx = 1.0;

// By so much more than the first one's the second one's cost may be, of all points, to count for
// more than a warning. Behind boards it is up to 0.18 more in most frames; with what a quarter of
// the points agree on by chance, 0.2 to 0.35. Higher, at 0.22, boards mislead in fewer frames, and
// what is only by chance in more.
constexpr double kMaxCostAbove = 0.20;

// A point of the motion that lies behind counts for so many of the one before it: what covers
// something is nearer than that. Nor is it more, as the distance alone may agree on what is wrong:
// the sky with the lens's own shading, in a quarry, a third as many points as the ground.
constexpr double kPointsBehind = 2.5;

// Those that go with one motion and not with the other.
struct Support {
  int count = 0;
  double inverse_depths = 0.0;  // sum, f / z
};

struct Supports {
  int visible = 0;  // points that either puts into the image
  Support first;
  Support second;
};

bool is_supported(const Support& support, int visible) {
  return support.count > kMinSupport * visible;
}

bool is_world(const Support& support, const Support& other) {
  const bool is_behind =
      support.inverse_depths * other.count < other.inverse_depths * support.count;
  return is_behind ? kPointsBehind * support.count > other.count
                   : support.count > kPointsBehind * other.count;
}

// @pre points go with the second.
double difference_px(const Alignment& first, const Alignment& second, const Support& by_second) {
  const double difference_m = minus(first.T_current_key, second.T_current_key).head<3>().norm();
  return difference_m * by_second.inverse_depths / by_second.count;
}

PointWarp warp_at(const MotionSearch& search, int level, const Alignment& alignment) {
  return make_warp(alignment.T_current_key, search.frame[level]);
}

void sample(const MotionSearch& search, int level, const Alignment& alignment) {
  search.kernels.sample_residuals(search.keyframe.levels[level].points,
                                  warp_at(search, level, alignment), search.frame[level].planes,
                                  search.residuals);
}

// Of all points.
AlignmentScore score(const MotionSearch& search, int level, const Alignment& alignment) {
  sample(search, level, alignment);
  return score_residuals(search.keyframe.levels[level].points, search.residuals,
                         warp_at(search, level, alignment), search.frame[level].planes);
}

std::span<const std::uint8_t> choose_near(const TemplateLevel& level,
                                          std::span<std::uint8_t> chosen) {
  const float limit = kNear * level.mean_inverse_depth_focal;
  for (int i = 0; i < level.points.count; ++i) {
    chosen[static_cast<std::size_t>(i)] = level.points.inverse_depth_focal[i] > limit ? 1 : 0;
  }
  return chosen.first(static_cast<std::size_t>(level.points.count));
}

std::span<const std::uint8_t> choose_fitting(const MotionSearch& search, int level,
                                             const Alignment& alignment,
                                             std::span<std::uint8_t> chosen) {
  sample(search, level, alignment);
  const int count = search.keyframe.levels[level].points.count;
  for (int i = 0; i < count; ++i) {
    const float squares = search.residuals.squares[i];
    chosen[static_cast<std::size_t>(i)] = squares >= 0.0f && squares < kMaxFitSquares ? 1 : 0;
  }
  return chosen.first(static_cast<std::size_t>(count));
}

// As align_frame(), without the points that `choose(level)` gives, and to a tenth of a pixel only.
template <typename Choose>
Alignment align_without(const MotionSearch& search, const Choose& choose) {
  const auto align = [&search, &choose](int level, Alignment& alignment) {
    align_level(search.kernels, search.keyframe.levels[level], search.frame[level],
                task_of_level(std::max(level, 1), choose(level)), search.residuals, alignment);
  };
  const auto score_all = [&search](int level, const Alignment& alignment) {
    return score(search, level, alignment);
  };
  return align_from_coarse(static_cast<int>(search.frame.size()), search.guesses, align, score_all);
}

// Counts point `i` where it is of this motion.
void count_if(bool is_with, const TemplatePoints& points, int i, Support& support) {
  if (!is_with) return;
  ++support.count;
  support.inverse_depths += static_cast<double>(points.inverse_depth_focal[i]);
}

Supports divide_points(const MotionSearch& search, const Alignment& first,
                       const Alignment& second) {
  const TemplatePoints& points = search.keyframe.levels[0].points;
  const MotionScratch& of = search.scratch;
  sample(search, 0, first);
  std::copy_n(search.residuals.squares, points.count, of.squares.begin());
  sample(search, 0, second);
  const auto is_better = [](float squares, float other) {
    return squares >= 0.0f && squares < kMaxFitSquares &&
           (other < 0.0f || squares < kClearlyBetter * other);
  };
  Supports supports;
  for (int i = 0; i < points.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const float by_first = of.squares[k];
    const float by_second = search.residuals.squares[i];
    supports.visible += by_first >= 0.0f || by_second >= 0.0f ? 1 : 0;
    const bool is_with_first = is_better(by_first, by_second);
    const bool is_with_second = is_better(by_second, by_first);
    of.by_first[k] = is_with_first ? 1 : 0;
    of.by_second[k] = is_with_second ? 1 : 0;
    count_if(is_with_first, points, i, supports.first);
    count_if(is_with_second, points, i, supports.second);
  }
  return supports;
}

struct Second {
  Alignment alignment;
  Supports by;
};

// The motion of what `first` is not of: of those found that points go with, the one that ranks
// better. Its iterations include all that were needed to find it.
Second find_second(const MotionSearch& search, const Alignment& first) {
  const std::span<std::uint8_t> chosen = search.scratch.by_first;
  const Alignment behind = align_without(search, [&search, chosen](int level) {
    return choose_near(search.keyframe.levels[level], chosen);
  });
  const Alignment rest = align_without(search, [&search, &first, chosen](int level) {
    return choose_fitting(search, level, first, chosen);
  });
  const bool is_behind_better = behind.score.rank() < rest.score.rank();
  Second second;
  for (const Alignment& found :
       {is_behind_better ? behind : rest, is_behind_better ? rest : behind}) {
    second = {found, divide_points(search, first, found)};
    if (is_supported(second.by.second, second.by.visible)) break;
  }
  second.alignment.iterations = behind.iterations + rest.iterations;
  return second;
}

}  // namespace

MotionScratch allocate_motion_scratch(int points_per_level, Arena& arena) {
  const int count = round_up_to_lanes(points_per_level);
  const auto flags = [&] { return arena.allocate<std::uint8_t>(count, "motions of points"); };
  return {arena.allocate<float>(count, "residuals of a motion"), flags(), flags()};
}

double share_of_misfits(const TemplatePoints& points, const PointResiduals& residuals) {
  int visible = 0;
  int misfits = 0;
  for (int i = 0; i < points.count; ++i) {
    visible += residuals.squares[i] >= 0.0f ? 1 : 0;
    misfits += residuals.squares[i] > kMinMisfitSquares ? 1 : 0;
  }
  return static_cast<double>(misfits) / std::max(visible, 1);
}

MotionCount separate_motions(const MotionSearch& search, Alignment& alignment) {
  const Alignment first = alignment;
  const auto [second, by] = find_second(search, first);
  const int iterations = first.iterations + second.iterations;
  const bool is_alike =
      !search.is_expected && difference_px(first, second, by.second) < kMinDifferencePx;
  const bool is_one = !is_supported(by.second, by.visible) ||
                      kMaxImbalance * by.second.count < by.first.count || is_alike;
  const bool is_poor = !search.is_expected && second.score.cost > first.score.cost + kMaxCostAbove;
  if (is_one || is_poor) {
    sample(search, 0, alignment);
    alignment.iterations = iterations;
    const bool is_certain = is_one || !is_supported(by.first, by.visible);
    return is_certain ? MotionCount::kOne : MotionCount::kUncertain;
  }
  const bool is_second_world = is_world(by.second, by.first);
  alignment = is_second_world ? second : first;
  alignment.iterations = iterations;
  const auto count = static_cast<std::size_t>(search.keyframe.levels[0].points.count);
  const std::span<const std::uint8_t> body =
      (is_second_world ? search.scratch.by_first : search.scratch.by_second).first(count);
  align_level(search.kernels, search.keyframe.levels[0], search.frame[0], task_of_level(0, body),
              search.residuals, alignment);
  alignment.score = score(search, 0, alignment);
  leave_out(body, alignment.score.visible_count, search.residuals);
  const AlignmentScore of_world =
      score_residuals(search.keyframe.levels[0].points, search.residuals,
                      warp_at(search, 0, alignment), search.frame[0].planes);
  alignment.score.distance = 0.5 * (alignment.score.distance + of_world.distance);
  return MotionCount::kTwo;
}

}  // namespace darkling
