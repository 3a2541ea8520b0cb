// SPDX-License-Identifier: Apache-2.0
// Datasets that `render` writes are what the readers of datasets expect, and hold the truth.
#include <filesystem>

#include <gmock/gmock.h>

#include "app/open_source.h"
#include "app/verb_render.h"
#include "drivers/synthetic/synthetic_source.h"
#include "support/temporary_folder.h"

namespace darkling {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;

RenderOptions small_render(const std::string& folder) {
  RenderOptions options;
  options.spec.scene = "corridor";
  options.spec.frames = 3;
  options.spec.width = 96;
  options.folder = folder;
  return options;
}

// What is played from `folder` equals what the scene itself gives: pixels, stamps, cameras, truth.
void expect_replays(const RenderOptions& options) {
  auto recording = open_source(options.folder, {});
  ASSERT_TRUE(recording.has_value()) << recording.error().message;
  const auto scene = SyntheticSource::create(options.spec);
  ASSERT_TRUE(recording->source->start().has_value());
  ASSERT_TRUE((*scene)->start().has_value());
  for (int k = 0; k < options.spec.frames; ++k) {
    const WaitResult played = recording->source->wait_next(Duration(0));
    const WaitResult shown = (*scene)->wait_next(Duration(0));
    ASSERT_EQ(played.status, WaitStatus::kFrame);
    for (const auto eye : {&StereoFrame::left, &StereoFrame::right}) {
      const auto& a = played.lease.frame().*eye;
      const auto& b = shown.lease.frame().*eye;
      ASSERT_TRUE(have_same_size(a, b));
      for (int y = 0; y < a.height; ++y) {
        ASSERT_TRUE(std::equal(a.row(y), a.row(y) + a.width, b.row(y))) << k << " row " << y;
      }
    }
  }
  EXPECT_EQ(recording->source->wait_next(Duration(0)).status, WaitStatus::kEndOfSource);
  const StereoRig& rig = (*scene)->rig();
  EXPECT_NEAR(recording->rig.left.fx, rig.left.fx, 1e-9);
  EXPECT_EQ(recording->rig.right.coefficients, rig.right.coefficients);
  const Se3 T_left_right = rig.T_body_rawleft.inverse() * rig.T_body_rawright;
  const Se3 found = recording->rig.T_body_rawleft.inverse() * recording->rig.T_body_rawright;
  EXPECT_LT(minus(found, T_left_right).norm(), 1e-9);
  const auto truth = read_trajectory(recording->truth_path);
  ASSERT_TRUE(truth.has_value()) << truth.error().message;
  ASSERT_EQ(truth->poses.size(), 3u);
  Se3 T = (*scene)->T_world_body(2);
  if (truth->frame == PoseFrame::kLeft) T = rig.T_body_rawleft.inverse() * T * rig.T_body_rawleft;
  EXPECT_LT((truth->poses[2].T_world_pose.matrix() - T.matrix()).norm(), 1e-12);
}

TEST(Render, WritesAnEurocFolderThatReplaysUnrectifiedCamerasToo) {
  const TemporaryFolder folder;
  RenderOptions options = small_render(folder / "new/euroc");
  options.spec.distortion = 0.7;
  options.spec.roll_right_deg = -1.0;
  const auto status = run_render(options);
  ASSERT_TRUE(status.has_value()) << status.error().message;
  EXPECT_EQ(*status, 0);
  expect_replays(options);
}

TEST(Render, WritesAKittiFolderThatReplays) {
  const TemporaryFolder folder;
  RenderOptions options = small_render(folder / "kitti");
  options.layout = DatasetLayout::kKitti;
  ASSERT_TRUE(run_render(options).has_value());
  expect_replays(options);
}

TEST(Render, RefusesKittiForUnrectifiedCameras) {
  const TemporaryFolder folder;
  RenderOptions options = small_render(folder / "kitti");
  options.layout = DatasetLayout::kKitti;
  options.spec.distortion = 0.5;
  const auto status = run_render(options);
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ExitCode::kUsage);
  EXPECT_THAT(status.error().message, HasSubstr("rectified images only"));
}

TEST(Render, LeavesAFolderAloneThatIsNotEmpty) {
  const TemporaryFolder folder;
  test::write_text(folder / "mine.txt", "mine");
  const auto status = run_render(small_render(folder.path()));
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ExitCode::kUsage);
  EXPECT_THAT(status.error().message, HasSubstr("is not empty"));
  EXPECT_FALSE(std::filesystem::exists(folder / "mav0"));
}

TEST(Render, ReplacesTheDatasetAndNothingElseWhenForced) {
  const TemporaryFolder folder;
  test::write_text(folder / "mine.txt", "mine");
  test::write_text(folder / "mav0/cam0/data/1.png", "old");
  RenderOptions options = small_render(folder.path());
  options.is_forced = true;
  ASSERT_TRUE(run_render(options).has_value());
  EXPECT_FALSE(std::filesystem::exists(folder / "mav0/cam0/data/1.png"));
  EXPECT_EQ(test::read_text(folder / "mine.txt"), "mine");
  expect_replays(options);
}

TEST(Render, RefusesATargetThatCannotBeWrittenBeforeItRenders) {
  const TemporaryFolder folder;
  test::write_text(folder / "file", "");
  for (const std::string& target : {folder / "file", folder / "file/below"}) {
    const auto status = run_render(small_render(target));
    ASSERT_FALSE(status.has_value()) << target;
    EXPECT_EQ(status.error().code, ExitCode::kUsage);
    EXPECT_THAT(status.error().message, HasSubstr(folder / "file"));
  }
}

}  // namespace
}  // namespace darkling
