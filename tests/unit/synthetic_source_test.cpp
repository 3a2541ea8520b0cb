// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/synthetic_source.h"

#include <vector>

#include <gtest/gtest.h>

namespace darkling {
namespace {

SyntheticSpec small(const std::string& scene, std::uint64_t seed = 1) {
  SyntheticSpec spec;
  spec.scene = scene;
  spec.seed = seed;
  spec.frames = 4;
  spec.width = 80;
  return spec;
}

std::vector<std::uint8_t> play(SyntheticSource& source) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(source.start().has_value());
  while (true) {
    const WaitResult next = source.wait_next(Duration(0));
    if (next.status != WaitStatus::kFrame) break;
    const StereoFrame& frame = next.lease.frame();
    for (const auto& eye : {frame.left, frame.right}) {
      for (int y = 0; y < eye.height; ++y) {
        bytes.insert(bytes.end(), eye.row(y), eye.row(y) + eye.width);
      }
    }
  }
  source.stop();
  return bytes;
}

std::vector<std::uint8_t> render(const SyntheticSpec& spec, int threads) {
  return play(**SyntheticSource::create(spec, threads));
}

TEST(SyntheticSource, GivesTheSameBytesForTheSameSeedOnlyWhateverTheThreads) {
  const auto source = SyntheticSource::create(small("mine"), 1);
  const auto once = play(**source);
  EXPECT_EQ(once.size(), 4u * 2u * 80u * 60u);
  EXPECT_EQ(once, play(**source)) << "started again";
  EXPECT_EQ(once, render(small("mine"), 3));
  EXPECT_NE(once, render(small("mine", 2), 3)) << "another seed";
}

TEST(SyntheticSource, TellsStampsAndPosesFromTheFirstFrameOn) {
  const auto source = SyntheticSource::create(small("corridor"));
  EXPECT_EQ((*source)->stamp(3) - (*source)->stamp(0), std::chrono::milliseconds(150));
  EXPECT_LT((*source)->T_world_body(0).log().norm(), 1e-12);
  EXPECT_GT((*source)->T_world_body(3).translation().x(), 0.05);
}

TEST(SyntheticSource, TimesOutRatherThanHangsWhenAllBuffersAreOnLease) {
  SyntheticSpec spec = small("corridor");
  spec.frames = 8;
  const auto source = SyntheticSource::create(spec, 1);
  ASSERT_TRUE((*source)->start().has_value());
  std::vector<FrameLease> leases;
  WaitResult next = (*source)->wait_next(Duration(0));
  while (next.status == WaitStatus::kFrame) {
    leases.push_back(std::move(next.lease));
    next = (*source)->wait_next(Duration(0));
  }
  EXPECT_EQ(next.status, WaitStatus::kTimeout);
  leases.clear();
  EXPECT_EQ((*source)->wait_next(Duration(0)).status, WaitStatus::kFrame);
}

TEST(SyntheticSource, RefusesABadSpecification) {
  EXPECT_EQ(SyntheticSource::create(small("cave")).error().code, ExitCode::kUsage);
}

TEST(SyntheticRig, IsWhatWasAskedFor) {
  SyntheticSpec spec = small("mine");
  ASSERT_TRUE(check_synthetic(spec).has_value());
  EXPECT_EQ(make_synthetic_rig(spec).left.distortion, Distortion::kNone);
  spec.distortion = 1.0;
  spec.roll_right_deg = 2.0;
  const StereoRig rig = make_synthetic_rig(spec);
  EXPECT_EQ(rig.left.distortion, Distortion::kRadTan);
  EXPECT_NEAR(rotation_angle(rig.T_body_rawleft.inverse() * rig.T_body_rawright), 0.0349, 1e-4);
  EXPECT_TRUE(check_rig(rig).has_value());
}

}  // namespace
}  // namespace darkling
