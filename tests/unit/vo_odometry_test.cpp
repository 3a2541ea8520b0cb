// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>

#include "support/kernel_cases.h"
#include "support/synthetic_run.h"
#include "vo/covariance.h"
#include "vo/limits.h"
#include "vo/odometry.h"

namespace darkling {
namespace {

using test::KeptFrame;
using test::SyntheticRun;
using ::testing::HasSubstr;

constexpr char kCorridor[] = "corridor,frames=12,width=160,seed=2";
constexpr char kElsewhere[] = "quarry,frames=6,width=160,seed=3";

MonotonicTime stopped_clock() {
  return MonotonicTime();
}

std::unique_ptr<Odometry> make_odometry(const SyntheticRun& run, const KernelTable& kernels = {},
                                        OdometryConfig config = {.width_px = 160}) {
  auto odometry = Odometry::create(config, run.rig, kernels, stopped_clock);
  EXPECT_TRUE(odometry) << odometry.error().message;
  return std::move(*odometry);
}

std::vector<Estimate> track_all(Odometry& odometry, const std::vector<KeptFrame>& frames) {
  std::vector<Estimate> estimates;
  for (const KeptFrame& frame : frames) {
    estimates.push_back(odometry.track(frame.at(static_cast<std::int64_t>(estimates.size()))));
  }
  return estimates;
}

std::vector<Estimate> track_all(const SyntheticRun& run, const KernelTable& kernels = {}) {
  return track_all(*make_odometry(run, kernels), run.frames);
}

// How far two poses are apart.
double metres_apart(const Se3& a, const Se3& b) {
  return (a.translation() - b.translation()).norm();
}

bool is_finite(const Estimate& e) {
  return e.T_world_left.matrix().allFinite() && e.T_world_body.matrix().allFinite() &&
         e.T_previous_body.matrix().allFinite() && std::isfinite(e.cost) &&
         std::isfinite(e.visible_fraction);
}

// Everything that an estimate says, times apart, bit for bit.
std::vector<double> numbers_of(const Estimate& e) {
  std::vector<double> numbers = {double(e.sequence),    double(e.status),
                                 double(e.reasons),     double(e.quality),
                                 double(e.is_keyframe), double(e.reset_counter),
                                 double(e.point_count), double(e.iterations),
                                 double(e.refinement),  e.cost,
                                 e.visible_fraction};
  for (const Se3& T : {e.T_world_left, e.T_world_body, e.T_previous_body}) {
    numbers.insert(numbers.end(), T.translation().data(), T.translation().data() + 3);
    const Eigen::Vector4d& q = T.rotation().coeffs();
    numbers.insert(numbers.end(), q.data(), q.data() + 4);
  }
  for (const Matrix6& covariance : {e.cov_previous_body, e.cov_world_body}) {
    numbers.insert(numbers.end(), covariance.data(), covariance.data() + covariance.size());
  }
  return numbers;
}

bool are_same_bits(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::vector<double> left = numbers_of(a[i]);
    const std::vector<double> right = numbers_of(b[i]);
    if (std::memcmp(left.data(), right.data(), left.size() * sizeof(double)) != 0) return false;
  }
  return true;
}

TEST(Odometry, MakesTheFirstFrameItsKeyframeAndWorld) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  const Estimate first = make_odometry(run)->track(run.frames[0].at(0));
  EXPECT_EQ(first.status, TrackStatus::kValid);
  EXPECT_TRUE(first.is_keyframe);
  EXPECT_EQ(first.quality, 100);
  EXPECT_EQ(first.reset_counter, 0);
  EXPECT_GT(first.point_count, 60);
  EXPECT_EQ(first.T_world_left.matrix(), Eigen::Matrix4d::Identity());
  EXPECT_TRUE(first.T_world_body.matrix().isIdentity(1e-12));
}

TEST(Odometry, FollowsTheTruth) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  const std::vector<Estimate> estimates = track_all(run);
  double path_m = 0.0;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (i > 0) path_m += metres_apart(run.T_world_body[i], run.T_world_body[i - 1]);
    EXPECT_EQ(estimates[i].status, TrackStatus::kValid) << i;
    EXPECT_EQ(estimates[i].reset_counter, 0);
    EXPECT_LT(metres_apart(estimates[i].T_world_body, run.T_world_body[i]), 0.002 + 0.02 * path_m)
        << i;
  }
  EXPECT_GT(path_m, 0.3);  // or nothing was tracked
}

TEST(Odometry, ReportsMotionsThatMultiplyToThePoseWithoutRefinement) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  const auto odometry = make_odometry(run, {}, {.width_px = 160, .refinement = false});
  Se3 T_world_body;
  for (const Estimate& e : track_all(*odometry, run.frames)) {
    T_world_body = T_world_body * e.T_previous_body;
    EXPECT_LT(minus(T_world_body, e.T_world_body).norm(), 1e-9);
  }
}

TEST(Odometry, GivesTheSameBitsOnEveryRunAndWithEveryKernel) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  const std::vector<Estimate> expected = track_all(run);
  for (const KernelTable& kernels : test::available_tables()) {
    EXPECT_TRUE(are_same_bits(track_all(run, kernels), expected)) << kernels.name;
  }
  std::vector<Estimate> changed = expected;
  changed.back().T_world_left = plus(changed.back().T_world_left, Vector6::Constant(1e-15));
  EXPECT_FALSE(are_same_bits(changed, expected));  // the comparison sees a single bit
}

TEST(Odometry, SaysHowWellItKnowsMotionAndPose) {
  const std::vector<Estimate> estimates = track_all(test::synthetic_run(kCorridor));
  EXPECT_EQ(estimates[0].cov_world_body, Matrix6::Zero()) << "the first pose is World";
  EXPECT_EQ(estimates[0].cov_previous_body, unknown_covariance()) << "there is no motion to it";
  for (std::size_t i = 1; i < estimates.size(); ++i) {
    for (const Matrix6& covariance :
         {estimates[i].cov_previous_body, estimates[i].cov_world_body}) {
      EXPECT_TRUE(is_known(covariance)) << i;
      EXPECT_GT(covariance.determinant(), 0.0) << i;
      EXPECT_LT(covariance.diagonal().maxCoeff(), 1e-3) << i;
    }
  }
  EXPECT_GT(estimates.back().cov_world_body.trace(), 2.0 * estimates[1].cov_world_body.trace());
}

TEST(Odometry, KnowsNoMotionToOrFromAPoseThatWasNotMeasured) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  std::vector<KeptFrame> frames = run.frames;
  frames[4] = test::flat_frame(frames[4], 0);
  const std::vector<Estimate> estimates = track_all(*make_odometry(run), frames);
  ASSERT_EQ(estimates[4].status, TrackStatus::kLost);
  EXPECT_EQ(estimates[4].cov_world_body, unknown_covariance());
  EXPECT_EQ(estimates[4].cov_previous_body, unknown_covariance());
  EXPECT_EQ(estimates[5].cov_previous_body, unknown_covariance());
  EXPECT_TRUE(is_known(estimates[5].cov_world_body)) << "the keyframe is still there";
  EXPECT_TRUE(is_known(estimates[6].cov_previous_body));
}

TEST(Odometry, PredictsThePoseThroughTheDarkAndGoesOnInTheLight) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  std::vector<KeptFrame> frames = run.frames;
  for (std::size_t i = 4; i < 9; ++i) frames[i] = test::flat_frame(frames[i], 0);
  const std::vector<Estimate> estimates = track_all(*make_odometry(run), frames);
  for (std::size_t i = 4; i < 9; ++i) {
    EXPECT_EQ(estimates[i].status, TrackStatus::kLost) << i;
    EXPECT_EQ(estimates[i].quality, -1);
    EXPECT_NE(estimates[i].reasons & kReasonTooDark, 0u);
    EXPECT_FALSE(estimates[i].is_keyframe) << "a bad frame never becomes a keyframe";
    EXPECT_LT(metres_apart(estimates[i].T_world_body, run.T_world_body[i]), 0.05) << i;
    EXPECT_TRUE(is_finite(estimates[i]));
  }
  // The keyframe from before the dark is still in sight: nothing is broken.
  for (std::size_t i = 9; i < 12; ++i) {
    EXPECT_EQ(estimates[i].status, TrackStatus::kValid) << i;
    EXPECT_EQ(estimates[i].reset_counter, 0);
    EXPECT_LT(metres_apart(estimates[i].T_world_body, run.T_world_body[i]), 0.02) << i;
  }
}

TEST(Odometry, AnchorsAgainOnTheThirdFrameOfAnotherPlace) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  const SyntheticRun& elsewhere = test::synthetic_run(kElsewhere);
  std::vector<KeptFrame> frames(run.frames.begin(), run.frames.begin() + 3);
  frames.insert(frames.end(), elsewhere.frames.begin(), elsewhere.frames.end());
  const std::vector<Estimate> estimates = track_all(*make_odometry(run), frames);
  const Se3 T_held = estimates[2].T_world_left;
  for (std::size_t i = 3; i < 6; ++i) {
    EXPECT_EQ(estimates[i].status, TrackStatus::kLost) << i;
    EXPECT_EQ(estimates[i].is_keyframe, i == 5) << i;
    EXPECT_EQ(estimates[i].reset_counter, i == 5 ? 1 : 0) << i;
    EXPECT_EQ(estimates[i].T_world_left.matrix(), T_held.matrix());
  }
  // From the held pose on, motion is measured again.
  const Se3 T_anchor_body = elsewhere.T_world_body[2].inverse() * elsewhere.T_world_body[5];
  EXPECT_EQ(estimates[8].status, TrackStatus::kValid);
  EXPECT_EQ(estimates[8].reset_counter, 1);
  EXPECT_LT(
      metres_apart(estimates[5].T_world_body.inverse() * estimates[8].T_world_body, T_anchor_body),
      0.01);
}

TEST(Odometry, PredictsAcrossAMissingPairAndFindsItsWayAfterwards) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  const auto odometry = make_odometry(run);
  for (int i = 0; i < 6; ++i) (void)odometry->track(run.frames[static_cast<std::size_t>(i)].at(i));
  const Estimate skipped = odometry->skip(6, run.frames[6].at(6).stamp, kReasonDropped);
  EXPECT_EQ(skipped.sequence, 6);
  EXPECT_EQ(skipped.status, TrackStatus::kLost);
  EXPECT_EQ(skipped.reasons, kReasonDropped);
  EXPECT_EQ(skipped.quality, -1);
  EXPECT_LT(metres_apart(skipped.T_world_body, run.T_world_body[6]), 0.02);
  EXPECT_GT(metres_apart(skipped.T_world_body, run.T_world_body[5]), 0.02);  // it moved on
  const Estimate next = odometry->track(run.frames[7].at(7));
  EXPECT_EQ(next.status, TrackStatus::kValid);
  EXPECT_EQ(next.reset_counter, 0);
  EXPECT_LT(metres_apart(next.T_world_body, run.T_world_body[7]), 0.02);
  const Se3 T_skipped_next = skipped.T_world_body.inverse() * next.T_world_body;
  EXPECT_LT(minus(next.T_previous_body, T_skipped_next).norm(), 5e-4);  // a refinement's share
}

TEST(Odometry, HoldsTheIdentityWhenPairsAreMissingBeforeTheFirst) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  const auto odometry = make_odometry(run);
  const Estimate skipped = odometry->skip(0, FrameTime(), kReasonDropped);
  EXPECT_EQ(skipped.T_world_left.matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(odometry->track(run.frames[1].at(1)).status, TrackStatus::kValid);
}

TEST(Odometry, WaitsForDepthBeforeItStarts) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  const auto odometry = make_odometry(run);
  for (int i = 0; i < 4; ++i) {
    const Estimate dark = odometry->track(test::flat_frame(run.frames[0], 0).at(i));
    EXPECT_EQ(dark.status, TrackStatus::kLost);
    EXPECT_EQ(dark.reasons & ~kReasonFrozen, kReasonTooDark);
    EXPECT_EQ(dark.reset_counter, 0);
  }
  const Estimate first = odometry->track(run.frames[0].at(4));
  EXPECT_EQ(first.status, TrackStatus::kValid);
  EXPECT_TRUE(first.is_keyframe);
}

TEST(Odometry, NamesSwappedEyesAndDoesNotStart) {
  for (const char* scene : {"mine", "quarry", "corridor"}) {
    const SyntheticRun& run =
        test::synthetic_run(std::string(scene) + ",frames=2,width=160,seed=2");
    const auto odometry = make_odometry(run);
    for (int i = 0; i < 2; ++i) {
      StereoFrame swapped = run.frames[i].at(i);
      std::swap(swapped.left, swapped.right);
      const Estimate estimate = odometry->track(swapped);
      EXPECT_EQ(estimate.status, TrackStatus::kLost) << scene;
      EXPECT_EQ(estimate.reasons, kReasonEyesSwapped) << scene;
      EXPECT_FALSE(estimate.is_keyframe) << scene;
    }
  }
}

TEST(Odometry, HardlyNoticesHalfTheGain) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  std::vector<KeptFrame> dim = run.frames;
  for (KeptFrame& frame : dim) {
    for (std::uint8_t& pixel : frame.left) pixel = static_cast<std::uint8_t>(pixel / 2);
    for (std::uint8_t& pixel : frame.right) pixel = static_cast<std::uint8_t>(pixel / 2);
  }
  const std::vector<Estimate> bright = track_all(run);
  const std::vector<Estimate> dimmed = track_all(*make_odometry(run), dim);
  const double path_m = run.T_world_body.back().translation().norm();
  for (std::size_t i = 0; i < bright.size(); ++i) {
    EXPECT_EQ(dimmed[i].status, TrackStatus::kValid) << i;
    EXPECT_LT(metres_apart(dimmed[i].T_world_body, bright[i].T_world_body), 0.1 * path_m) << i;
  }
}

TEST(Odometry, FollowsAGainThatChangesInMidRun) {
  const SyntheticRun& run = test::synthetic_run(kCorridor);
  std::vector<KeptFrame> frames = run.frames;
  for (std::size_t i = 5; i < frames.size(); ++i) {
    for (auto* eye : {&frames[i].left, &frames[i].right}) {
      for (std::uint8_t& pixel : *eye) pixel = static_cast<std::uint8_t>(pixel / 2);
    }
  }
  const std::vector<Estimate> estimates = track_all(*make_odometry(run), frames);
  EXPECT_EQ(estimates.back().status, TrackStatus::kValid);
  EXPECT_LT(metres_apart(estimates.back().T_world_body, run.T_world_body.back()), 0.02);
}

}  // namespace
}  // namespace darkling
