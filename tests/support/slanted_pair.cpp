// SPDX-License-Identifier: Apache-2.0
#include "support/slanted_pair.h"

#include <cmath>

#include "support/random.h"

namespace darkling::test {

namespace {

RectifiedRig rig_for(int matched_level) {
  RectifiedRig rig = ideal_rig();
  rig.width <<= matched_level;
  rig.height <<= matched_level;
  return rig;
}

SmoothTexture::Waves waves_of(const Surface& surface, int matched_level) {
  // Fine enough for level 0, and coarse enough to be seen on the matched one.
  const double size = matched_level == 0 ? 1.0 : 1.5;
  SmoothTexture::Waves waves{
      .min_length = 4.0 * size, .max_length = 40.0 * size, .deviation = 50.0, .seed = 17};
  if (surface.weave == Weave::kMixed) return waves;
  waves.count = 20;
  waves.seed += 1 + surface.draw;
  waves.min_length = surface.weave == Weave::kFine    ? 2.5
                     : surface.weave == Weave::kBlobs ? 16.0
                                                      : 12.0;
  waves.max_length = surface.weave == Weave::kFine ? 6.0 : 40.0;
  return waves;
}

double level_at(const SmoothTexture& texture, Weave weave, double x, double y) {
  const double level = texture.mean(x, y, 1.0);
  if (weave != Weave::kEdges) return level;
  // Steep where the waves cross their mean, over about a pixel as a good lens leaves it. Patches
  // without any shade would be matched by their noise alone, a sixth of their points a pixel off.
  return 128.0 + 50.0 * std::tanh(0.15 * (level - 128.0)) + 0.4 * (level - 128.0);
}

// Of the twelve uniform numbers' sum, that is nearly normal; `deviation` is its standard deviation.
double noise(Random& random, double deviation) {
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) sum += random.uniform(-0.5, 0.5);
  return deviation * sum;
}

}  // namespace

SlantedPair::SlantedPair(const Surface& surface, int matched_level)
    : surface_(surface),
      matched_level_(matched_level),
      rig_(rig_for(matched_level)),
      left_(rig_, matched_level + 1, matched_level),
      right_(rig_, matched_level + 1, matched_level),
      matcher_(allocate_stereo_matcher(rig_.width >> matched_level, arena_)),
      disparity_(arena_.allocate_image<float>(rig_.width >> matched_level,
                                              rig_.height >> matched_level, "disparity")) {
  paint_eyes();
  left_.prepare(kernels_);
  right_.prepare(kernels_);
  known_share_ = match_stereo(kernels_, left_.codes(matched_level), right_.codes(matched_level),
                              matcher_, disparity_);
}

void SlantedPair::paint_eyes() {
  const SmoothTexture texture(waves_of(surface_, matched_level_));
  Random random(41 + surface_.draw);
  const auto seen_at = [&](double x, double y) {
    return level_at(texture, surface_.weave, x, y) +
           (surface_.noise_levels > 0.0 ? noise(random, surface_.noise_levels) : 0.0);
  };
  paint(left_.grey(), [&](int x, int y) { return seen_at(x, y); });
  paint(right_.grey(), [&](int x, int y) {
    return seen_at((x + surface_.d0_px + surface_.slope_y * y) / (1.0 - surface_.slope_x), y);
  });
}

PointSelector::Candidate SlantedPair::candidate(int x, int y) const {
  const float d = disparity_.at(x >> matched_level_, y >> matched_level_);
  return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), 0,
          d < 0.0f ? kNoDisparity : d * static_cast<float>(1 << matched_level_)};
}

std::vector<PointSelector::Candidate> SlantedPair::points(int count) const {
  Arena arena(4u << 20);
  const auto chosen = select_points(kernels_, left_.pyramid()[0], {disparity_, matched_level_},
                                    allocate_point_selector(rig_, count, arena));
  return {chosen.begin(), chosen.end()};
}

namespace {

// Adds up the errors of disparities one by one.
class ErrorSums {
 public:
  void add(double disparity_px, double truth_px) {
    ++seen_;
    if (disparity_px < 0.0) return;
    ++known_;
    const double e = disparity_px - truth_px;
    if (std::abs(e) >= 1.0) {
      ++bad_;
      return;
    }
    sum_ += e;
    squares_ += e * e;
  }
  [[nodiscard]] DisparityError result() const {
    const int good = std::max(known_ - bad_, 1);
    DisparityError error;
    error.bias_px = sum_ / good;
    error.spread_px = std::sqrt(std::max(squares_ / good - error.bias_px * error.bias_px, 0.0));
    error.bad_share = static_cast<double>(bad_) / std::max(known_, 1);
    error.known_share = static_cast<double>(known_) / std::max(seen_, 1);
    return error;
  }

 private:
  double sum_ = 0.0;
  double squares_ = 0.0;
  int seen_ = 0;
  int known_ = 0;
  int bad_ = 0;
};

constexpr int kAway = 8;  // px from the upper and lower border

// Where the right eye sees it too.
bool is_in_both(const SlantedPair& pair, int x, int y) {
  const ImageView<const std::uint8_t> grey = pair.left().grey;
  return x >= grey.width / 5 && x < grey.width - 10 && y >= kAway && y < grey.height - kAway;
}

}  // namespace

DisparityError measure_disparity(const SlantedPair& pair,
                                 std::span<const PointSelector::Candidate> points) {
  ErrorSums sums;
  for (const PointSelector::Candidate& c : points) {
    if (is_in_both(pair, c.x, c.y))
      sums.add(static_cast<double>(c.disparity_px), pair.truth(c.x, c.y));
  }
  return sums.result();
}

DisparityError measure_disparity(const SlantedPair& pair,
                                 const std::function<double(int, int)>& disparity_at) {
  ErrorSums sums;
  for (int y = 0; y < pair.left().grey.height; ++y) {
    for (int x = 0; x < pair.left().grey.width; ++x) {
      if (is_in_both(pair, x, y)) sums.add(disparity_at(x, y), pair.truth(x, y));
    }
  }
  return sums.result();
}

}  // namespace darkling::test
