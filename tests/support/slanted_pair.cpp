// SPDX-License-Identifier: Apache-2.0
#include "support/slanted_pair.h"

#include <cmath>

namespace darkling::test {

namespace {

RectifiedRig rig_for(int matched_level) {
  RectifiedRig rig = ideal_rig();
  rig.width <<= matched_level;
  rig.height <<= matched_level;
  return rig;
}

}  // namespace

SlantedPair::SlantedPair(double d0_px, double slope, int matched_level)
    : d0_px_(d0_px),
      slope_(slope),
      matched_level_(matched_level),
      rig_(rig_for(matched_level)),
      left_(rig_, matched_level + 1, matched_level),
      right_(rig_, matched_level + 1, matched_level),
      matcher_(allocate_stereo_matcher(rig_.width >> matched_level, arena_)),
      disparity_(arena_.allocate_image<float>(rig_.width >> matched_level,
                                              rig_.height >> matched_level, "disparity")) {
  // Fine enough for level 0, and coarse enough to be seen on the matched one.
  const double size = matched_level == 0 ? 1.0 : 1.5;
  const SmoothTexture texture(
      {.min_length = 4.0 * size, .max_length = 40.0 * size, .deviation = 50.0, .seed = 17});
  paint(left_.grey(), [&](int x, int y) { return texture.mean(x, y, 1.0); });
  paint(right_.grey(),
        [&](int x, int y) { return texture.mean((x + d0_px) / (1.0 - slope), y, 1.0); });
  left_.prepare(kernels_);
  right_.prepare(kernels_);
  known_share_ = match_stereo(kernels_, left_.codes(matched_level), right_.codes(matched_level),
                              matcher_, disparity_);
}

PointSelector::Candidate SlantedPair::candidate(int x, int y) const {
  const float d = disparity_.at(x >> matched_level_, y >> matched_level_);
  return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), 0,
          d < 0.0f ? kNoDisparity : d * static_cast<float>(1 << matched_level_)};
}

DisparityError measure_disparity(const SlantedPair& pair,
                                 const std::function<double(int, int)>& disparity_at) {
  const int width = pair.left().grey.width;
  const int height = pair.left().grey.height;
  double sum = 0.0;
  double squares = 0.0;
  int seen = 0;
  int known = 0;
  int bad = 0;
  for (int y = 8; y < height - 8; ++y) {
    for (int x = width / 5; x < width - 10; ++x) {  // where the right eye sees it too
      ++seen;
      const double d = disparity_at(x, y);
      if (d < 0.0) continue;
      ++known;
      const double e = d - pair.truth(x);
      if (std::abs(e) >= 1.0) {
        ++bad;
        continue;
      }
      sum += e;
      squares += e * e;
    }
  }
  const int good = std::max(known - bad, 1);
  DisparityError error;
  error.bias_px = sum / good;
  error.spread_px = std::sqrt(std::max(squares / good - error.bias_px * error.bias_px, 0.0));
  error.bad_share = static_cast<double>(bad) / std::max(known, 1);
  error.known_share = static_cast<double>(known) / seen;
  return error;
}

}  // namespace darkling::test
