// SPDX-License-Identifier: Apache-2.0
// Stereo on real pairs with dense truth, reduced to thumbnails.
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "support/pixels.h"
#include "support/recordings.h"
#include "support/vo_stages.h"
#include "vo/refine_disparity.h"

namespace darkling {
namespace {

// Means of k×k boxes, as the rectifying map makes them.
void reduce(const cv::Mat& image, int k, ImageView<std::uint8_t> out) {
  test::paint(out, [&](int x, int y) {
    double sum = 0.0;
    for (int i = 0; i < k * k; ++i) sum += image.at<std::uint8_t>(y * k + i / k, x * k + i % k);
    return sum / (k * k);
  });
}

// The true disparity of a thumbnail's pixel in its own pixels: the mean of its box where all of it
// is known and of one surface, else kNoDisparity. The file's 0 is unknown.
double true_disparity(const cv::Mat& truth, int k, int x, int y) {
  double sum = 0.0;
  int least = 255;
  int most = 0;
  for (int i = 0; i < k * k; ++i) {
    const int d = truth.at<std::uint8_t>(y * k + i / k, x * k + i % k);
    sum += d;
    least = std::min(least, d);
    most = std::max(most, d);
  }
  const bool is_one_surface = least > 0 && most - least <= k;
  return is_one_surface ? sum / (k * k) / k : static_cast<double>(kNoDisparity);
}

struct StereoQuality {
  int with_truth = 0;        // pixels, or points
  double known_share = 0.0;  // of those
  double bad_share = 1.0;    // of the known: off by more than a thumbnail pixel
  double bias_px = 0.0;      // mean error of the others, after refinement
};

// Sums up pixels or points.
struct StereoErrors {
  int with_truth = 0;
  int known = 0;
  int bad = 0;
  int refined = 0;
  double sum_px = 0.0;

  [[nodiscard]] StereoQuality quality() const {
    return {.with_truth = with_truth,
            .known_share = double(known) / std::max(with_truth, 1),
            .bad_share = double(bad) / std::max(known, 1),
            .bias_px = sum_px / std::max(refined, 1)};
  }
};

// The pair as thumbnails, k times smaller, matched where the pipeline would match it.
class AloePair {
 public:
  AloePair(const std::string& folder, int k)
      : k_(k),
        truth_(cv::imread(folder + "/aloeGT.png", cv::IMREAD_GRAYSCALE)),
        rig_(thumbnail_rig(truth_, k)) {
    const cv::Mat left = cv::imread(folder + "/aloeL.jpg", cv::IMREAD_GRAYSCALE);
    const cv::Mat right = cv::imread(folder + "/aloeR.jpg", cv::IMREAD_GRAYSCALE);
    EXPECT_TRUE(!left.empty() && left.size() == right.size() && left.size() == truth_.size());
    reduce(left, k, left_.grey());
    reduce(right, k, right_.grey());
    left_.prepare(kernels_);
    right_.prepare(kernels_);
    (void)match_stereo(kernels_, left_.codes(level_), right_.codes(level_), matcher_,
                       disparities_.levels[0]);
  }

  // Of all pixels.
  [[nodiscard]] StereoQuality measure_pixels() const {
    StereoErrors errors;
    for (int y = 0; y < rig_.height; ++y) {
      for (int x = 0; x < rig_.width; ++x) {
        if (!is_in_reach(x, y)) continue;
        ++errors.with_truth;
        const float d = disparities_.levels[0].at(x, y);
        if (d >= 0.0f) count({std::uint16_t(x), std::uint16_t(y), 0, d}, errors);
      }
    }
    return errors.quality();
  }

  // Of the points that a keyframe would take.
  [[nodiscard]] StereoQuality measure_points() {
    const PointSelector selector = allocate_point_selector(rig_, 1000, arena_);
    const auto chosen =
        select_points(kernels_, left_.pyramid()[0], disparities_.at_level(0), selector);
    search_disparities(kernels_, left_.pyramid()[0], right_.pyramid()[0], level_, chosen);
    StereoErrors errors;
    for (const PointSelector::Candidate& point : chosen) {
      if (!is_in_reach(point.x, point.y)) continue;
      ++errors.with_truth;
      PointSelector::Candidate refined = point;
      if (refine(refined)) count(point, errors);
    }
    return errors.quality();
  }

  [[nodiscard]] int matched_level() const { return level_; }

 private:
  static RectifiedRig thumbnail_rig(const cv::Mat& image, int k) {
    RectifiedRig rig;
    rig.width = image.cols / k;
    rig.height = image.rows / k;
    return rig;
  }
  // Whether the truth is known, and among the disparities that are searched.
  [[nodiscard]] bool is_in_reach(int x, int y) const {
    const int reach_px = kDisparities << level_;
    const double expected = true_disparity(truth_, k_, x, y);
    return x >= reach_px && expected >= 0.0 && expected <= reach_px - (2 << level_);
  }
  [[nodiscard]] bool refine(PointSelector::Candidate& point) const {
    refine_disparities(kernels_, left_.pyramid()[0], right_.pyramid()[0], {&point, 1});
    return point.disparity_px >= 0.0f;
  }
  void count(PointSelector::Candidate point, StereoErrors& errors) const {
    const double expected = true_disparity(truth_, k_, point.x, point.y);
    ++errors.known;
    if (std::abs(double{point.disparity_px} - expected) > 1.0) {
      ++errors.bad;
    } else if (refine(point)) {
      ++errors.refined;
      errors.sum_px += double{point.disparity_px} - expected;
    }
  }

  int k_;
  cv::Mat truth_;
  RectifiedRig rig_;
  int level_ = stereo_level(rig_.width, 2);
  KernelTable kernels_;
  test::EyeStages left_{rig_, level_ + 1, level_};
  test::EyeStages right_{rig_, level_ + 1, level_};
  Arena arena_{32u << 20};
  StereoMatcher matcher_ = allocate_stereo_matcher(rig_.width >> level_, arena_);
  DisparityPyramid disparities_ =
      allocate_disparities(rig_.width, rig_.height, level_ + 1, level_, arena_);
};

class Aloe : public ::testing::Test {
 protected:
  void expect(const StereoQuality& quality, double max_bad_share, const std::string& name) {
    SCOPED_TRACE(name);
    RecordProperty("known_share_" + name, std::to_string(quality.known_share));
    RecordProperty("bad_share_" + name, std::to_string(quality.bad_share));
    RecordProperty("bias_px_" + name, std::to_string(quality.bias_px));
    EXPECT_GT(quality.known_share, 0.8);
    EXPECT_LT(quality.bad_share, max_bad_share);
    EXPECT_LT(std::abs(quality.bias_px), 0.1);
  }
};

TEST_F(Aloe, IsMatchedOnThumbnailsAsWideAsStereoAllows) {
  REQUIRE_RECORDING(folder, "middlebury");
  // Measured: 7.3 and 8.0 % bad.
  for (const auto& [k, max_bad_share] : {std::pair{7, 0.088}, std::pair{8, 0.096}}) {
    const AloePair pair(folder, k);
    ASSERT_EQ(pair.matched_level(), 0);
    const StereoQuality quality = pair.measure_pixels();
    EXPECT_GT(quality.with_truth, 1282 / k * (1110 / k) / 3);
    expect(quality, max_bad_share, std::to_string(k));
  }
}

TEST_F(Aloe, GivesThePointsOfFinerThumbnailsTheirDisparities) {
  REQUIRE_RECORDING(folder, "middlebury");
  // Measured: 8.0 and 8.3 % bad.
  for (const auto& [k, max_bad_share] : {std::pair{4, 0.096}, std::pair{6, 0.1}}) {
    AloePair pair(folder, k);
    ASSERT_EQ(pair.matched_level(), 1);
    const StereoQuality quality = pair.measure_points();
    EXPECT_GT(quality.with_truth, 300);
    expect(quality, max_bad_share, std::to_string(k));
  }
}

TEST(TrueDisparity, IsUnknownAcrossAnEdgeAndWhereTheFileSaysSo) {
  cv::Mat truth(2, 6, CV_8UC1, cv::Scalar(40));
  truth.at<std::uint8_t>(0, 2) = 0;
  truth.at<std::uint8_t>(1, 5) = 80;
  EXPECT_EQ(true_disparity(truth, 2, 0, 0), 20.0);
  EXPECT_LT(true_disparity(truth, 2, 1, 0), 0.0);
  EXPECT_LT(true_disparity(truth, 2, 2, 0), 0.0);
}

}  // namespace
}  // namespace darkling
