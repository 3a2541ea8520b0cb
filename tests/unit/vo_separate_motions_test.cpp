// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <vector>

#include "support/example_rigs.h"
#include "support/kernel_cases.h"
#include "support/random.h"
#include "support/vo_stages.h"
#include "vo/separate_motions.h"

namespace darkling {
namespace {

Se3 shift(double x, double y, double z) {
  return Se3(Eigen::Quaterniond::Identity(), Vector3(x, y, z));
}

// A wall and a floor, and between them and the camera a board of 1.2 m by 1.1 m, 2.5 m away, which
// covers a third of the image.
class SeparateMotions : public ::testing::Test {
 protected:
  SeparateMotions() : scratch_(allocate_motion_scratch(kPoints, arena_)) {
    paint_both(Se3(), Se3(), key_eye_.grey());
    key_eye_.prepare(kernels_);
    for (int y = 0; y < rig_.height; ++y) {
      for (int x = 0; x < rig_.width; ++x) {
        const double depth_m = is_board(Se3(), x, y) ? board_.depth_m(rig_, Se3(), x, y)
                                                     : world_.depth_m(rig_, Se3(), x, y);
        key_.disparity().at(x, y) = static_cast<float>(rig_.focal_px * rig_.baseline_m / depth_m);
      }
    }
    key_.build(kernels_, key_eye_.pyramid());
  }

  [[nodiscard]] bool is_board(const Se3& T_board_camera, int x, int y) const {
    const Vector3 p = T_board_camera * Vector3(kBoardDepthM * test::rectified_ray(rig_, x, y));
    return std::abs(p.x()) < 0.6 && std::abs(p.y()) < 0.55;
  }

  // The world from `T_world_camera` and, before it, the board from `T_board_camera`.
  void paint_both(const Se3& T_world_camera, const Se3& T_board_camera,
                  ImageView<std::uint8_t> image) {
    std::vector<std::uint8_t> board(static_cast<std::size_t>(rig_.width) * rig_.height);
    const ImageView<std::uint8_t> board_image(board.data(), rig_.width, rig_.height, rig_.width);
    world_.render(rig_, T_world_camera, image);
    board_.render(rig_, T_board_camera, board_image);
    for (int y = 0; y < rig_.height; ++y) {
      for (int x = 0; x < rig_.width; ++x) {
        if (is_board(T_board_camera, x, y)) image.at(x, y) = board_image.at(x, y);
      }
    }
  }

  // Aligns as tracking does, and then looks for two motions.
  MotionCount separate(const Se3& T_world_camera, const Se3& T_board_camera,
                       bool is_expected = false) {
    paint_both(T_world_camera, T_board_camera, eye_.grey());
    eye_.prepare(kernels_);
    const Se3 rest;
    const std::span<const Se3> guesses(&rest, 1);
    first_ = align_frame(kernels_, key_.keyframe(), eye_.pyramid(), guesses, key_.residuals());
    found_ = first_;
    return separate_motions({kernels_, key_.keyframe(), eye_.pyramid(), guesses, key_.residuals(),
                             scratch_, is_expected},
                            found_);
  }
  [[nodiscard]] static double error_m(const Alignment& found, const Se3& T_world_camera) {
    return minus(found.T_current_key, T_world_camera.inverse()).head<3>().norm();
  }

  static constexpr int kPoints = 800;
  static constexpr double kBoardDepthM = 2.5;
  RectifiedRig rig_ = test::ideal_rig();
  KernelTable kernels_;
  test::PlaneWorld world_;
  test::PlaneWorld board_{
      {.wall_z_m = kBoardDepthM, .floor_y_m = std::numeric_limits<double>::infinity(), .seed = 7}};
  test::EyeStages key_eye_{rig_, 3};
  test::EyeStages eye_{rig_, 3};
  test::TemplateStages key_{rig_, 3, kPoints};
  Arena arena_{1u << 20};
  MotionScratch scratch_;
  Alignment first_;
  Alignment found_;
};

TEST_F(SeparateMotions, FollowsTheWorldBehindABoardThatPasses) {
  const Se3 T_world_camera = shift(0.06, 0.0, 0.05);
  EXPECT_EQ(separate(T_world_camera, shift(-0.08, 0.02, 0.0)), MotionCount::kTwo);
  EXPECT_GT(error_m(first_, T_world_camera), 0.05) << "this board misleads nobody";
  EXPECT_LT(error_m(found_, T_world_camera), 0.01);
}

TEST_F(SeparateMotions, StandsStillBehindABoardThatPasses) {
  (void)separate(Se3(), shift(0.1, 0.0, 0.0));
  EXPECT_LT(error_m(found_, Se3()), 0.005);
}

// Between two frames in which it was told from the world a board may move nearly as that does.
TEST_F(SeparateMotions, TellsAnExpectedBoardByLess) {
  const Se3 T_world_camera = shift(0.01, 0.0, 0.06);
  const Se3 T_board_camera = shift(0.0, 0.01, 0.06);
  EXPECT_EQ(separate(T_world_camera, T_board_camera), MotionCount::kOne);
  EXPECT_GT(error_m(found_, T_world_camera), 0.015) << "this board misleads nobody";
  EXPECT_EQ(separate(T_world_camera, T_board_camera, true), MotionCount::kTwo);
  EXPECT_LT(error_m(found_, T_world_camera), 0.005);
}

TEST_F(SeparateMotions, LeavesWhatHasOneMotionAsItIs) {
  for (const Se3& T_world_camera : {Se3(), shift(0.05, 0.01, 0.1), shift(0.0, 0.0, 0.15)}) {
    EXPECT_EQ(separate(T_world_camera, T_world_camera), MotionCount::kOne);
    EXPECT_EQ(minus(found_.T_current_key, first_.T_current_key).norm(), 0.0);
    EXPECT_EQ(found_.score.cost, first_.score.cost);
    EXPECT_GT(found_.iterations, first_.iterations);
  }
}

TEST_F(SeparateMotions, CountsPointsOfTheBoardAsNotSeen) {
  ASSERT_EQ(separate(shift(0.06, 0.0, 0.05), shift(-0.08, 0.02, 0.0)), MotionCount::kTwo);
  const TemplatePoints& points = key_.keyframe().levels[0].points;
  int board = 0;
  int board_seen = 0;
  int world = 0;
  int world_seen = 0;
  for (int i = 0; i < points.count; ++i) {
    const bool is_seen = key_.residuals().squares[i] >= 0.0f;
    const int x = static_cast<int>(std::lround(points.x[i] + rig_.cx));
    const int y = static_cast<int>(std::lround(points.y[i] + rig_.cy));
    (is_board(Se3(), x, y) ? board : world) += 1;
    (is_board(Se3(), x, y) ? board_seen : world_seen) += is_seen ? 1 : 0;
  }
  EXPECT_GT(board, 100);
  EXPECT_LT(board_seen, board / 3);
  EXPECT_GT(world_seen, world / 2);
}

// Nothing is known of how an image of noise moved; what matters is that the search ends and gives
// numbers.
TEST_F(SeparateMotions, EndsWhereNothingFits) {
  test::Random random(3);
  for (int y = 0; y < rig_.height; ++y) {
    for (int x = 0; x < rig_.width; ++x) {
      eye_.grey().at(x, y) = static_cast<std::uint8_t>(random.integer(0, 255));
    }
  }
  eye_.prepare(kernels_);
  const Se3 rest;
  const std::span<const Se3> guesses(&rest, 1);
  found_ = align_frame(kernels_, key_.keyframe(), eye_.pyramid(), guesses, key_.residuals());
  EXPECT_GT(share_of_misfits(key_.keyframe().levels[0].points, key_.residuals()), 0.2);
  (void)separate_motions(
      {kernels_, key_.keyframe(), eye_.pyramid(), guesses, key_.residuals(), scratch_}, found_);
  EXPECT_TRUE(found_.T_current_key.log().allFinite());
  EXPECT_GT(found_.score.cost, 0.7);
}

TEST_F(SeparateMotions, FindsNoMisfitsInTheKeyframeItself) {
  (void)separate(Se3(), Se3());
  EXPECT_EQ(share_of_misfits(key_.keyframe().levels[0].points, key_.residuals()), 0.0);
}

}  // namespace
}  // namespace darkling
