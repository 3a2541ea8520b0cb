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
  double known_share = 0.0;  // of the pixels with a truth
  double bad_share = 1.0;    // of the known: off by more than a thumbnail pixel
  double bias_px = 0.0;      // mean error of the others, after refinement
};

class Aloe : public ::testing::Test {
 protected:
  // @param k  thumbnails are so many times smaller.
  StereoQuality measure(const std::string& folder, int k) {
    const cv::Mat left = cv::imread(folder + "/aloeL.jpg", cv::IMREAD_GRAYSCALE);
    const cv::Mat right = cv::imread(folder + "/aloeR.jpg", cv::IMREAD_GRAYSCALE);
    const cv::Mat truth = cv::imread(folder + "/aloeGT.png", cv::IMREAD_GRAYSCALE);
    EXPECT_TRUE(!left.empty() && left.size() == right.size() && left.size() == truth.size());
    RectifiedRig rig;
    rig.width = left.cols / k;
    rig.height = left.rows / k;
    const KernelTable kernels;
    test::EyeStages left_eye(rig, 1);
    test::EyeStages right_eye(rig, 1);
    reduce(left, k, left_eye.grey());
    reduce(right, k, right_eye.grey());
    left_eye.prepare(kernels);
    right_eye.prepare(kernels);
    Arena arena(32u << 20);
    StereoMatcher matcher = allocate_stereo_matcher(rig.width, rig.height, arena);
    (void)match_stereo(kernels, left_eye.codes(), right_eye.codes(), matcher);
    int with_truth = 0;
    int known = 0;
    int bad = 0;
    double sum = 0.0;
    int refined = 0;
    for (int y = 0; y < rig.height; ++y) {
      for (int x = matcher.disparities; x < rig.width; ++x) {
        const double expected = true_disparity(truth, k, x, y);
        if (expected < 0.0 || expected > matcher.disparities - 2) continue;
        ++with_truth;
        const float d = matcher.disparity.at(x, y);
        if (d < 0.0f) continue;
        ++known;
        if (std::abs(static_cast<double>(d) - expected) > 1.0) {
          ++bad;
          continue;
        }
        PointSelector::Candidate candidate = {static_cast<std::uint16_t>(x),
                                              static_cast<std::uint16_t>(y), 0, d};
        refine_disparities(left_eye.pyramid()[0], right_eye.pyramid()[0], {&candidate, 1});
        if (candidate.disparity_px < 0.0f) continue;
        sum += static_cast<double>(candidate.disparity_px) - expected;
        ++refined;
      }
    }
    EXPECT_GT(with_truth, rig.width * rig.height / 3);
    return {.known_share = double(known) / with_truth,
            .bad_share = double(bad) / std::max(known, 1),
            .bias_px = sum / std::max(refined, 1)};
  }
};

TEST_F(Aloe, IsMatchedOnThumbnails) {
  REQUIRE_RECORDING(folder, "middlebury");
  // Measured: 6.0 and 7.2 % bad.
  for (const auto& [k, max_bad_share] : {std::pair{4, 0.073}, std::pair{6, 0.087}}) {
    SCOPED_TRACE(k);
    const StereoQuality quality = measure(folder, k);
    const std::string suffix = std::to_string(k);
    RecordProperty("known_share_" + suffix, std::to_string(quality.known_share));
    RecordProperty("bad_share_" + suffix, std::to_string(quality.bad_share));
    RecordProperty("bias_px_" + suffix, std::to_string(quality.bias_px));
    EXPECT_GT(quality.known_share, 0.8);
    EXPECT_LT(quality.bad_share, max_bad_share);
    EXPECT_LT(std::abs(quality.bias_px), 0.1);
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
