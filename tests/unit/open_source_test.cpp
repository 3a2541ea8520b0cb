// SPDX-License-Identifier: Apache-2.0
#include "app/open_source.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/recordings.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

// The sequence numbers that the recording delivers.
std::vector<std::int64_t> play(FrameSource& source) {
  std::vector<std::int64_t> sequences;
  EXPECT_TRUE(source.start());
  for (;;) {
    const WaitResult result = source.wait_next(Duration{1'000'000'000});
    if (result.status != WaitStatus::kFrame) return sequences;
    sequences.push_back(result.lease.frame().sequence);
  }
}

class OpenSource : public ::testing::Test {
 protected:
  void SetUp() override {
    write_tiny_kitti(kitti_, {.frames = 6});
    write_tiny_euroc(euroc_, {.frames = 3});
  }

  static void expect_refused(const std::string& source, ExitCode code,
                             std::initializer_list<std::string> words,
                             const OpenOptions& options = {}) {
    const auto recording = open_source(source, options);
    ASSERT_FALSE(recording.has_value()) << source;
    EXPECT_EQ(recording.error().code, code) << recording.error().message;
    for (const std::string& word : words) EXPECT_THAT(recording.error().message, HasSubstr(word));
  }

  TemporaryFolder folder_;
  std::string kitti_ = folder_ / "kitti_tiny";
  std::string euroc_ = folder_ / "euroc_tiny";
};

TEST_F(OpenSource, OpensAKittiFolder) {
  const auto recording = open_source(kitti_ + "/", {});
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->name, "kitti_tiny");
  EXPECT_EQ(recording->kind, "KITTI");
  EXPECT_EQ(recording->frame_count, 6);
  EXPECT_EQ(recording->truth_path, kitti_ + "/poses.txt");
  EXPECT_EQ(recording->calibration_path, kitti_ + "/calib.txt");
  EXPECT_EQ(recording->rig.left.width, 96);
  EXPECT_THAT(play(*recording->source), ::testing::ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST_F(OpenSource, OpensAnEurocFolder) {
  const auto recording = open_source(euroc_, {});
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->kind, "EuRoC");
  EXPECT_EQ(recording->truth_path, euroc_ + "/groundtruth.tum");
  EXPECT_EQ(recording->calibration_path, euroc_ + "/mav0/cam0/sensor.yaml");
  EXPECT_THAT(play(*recording->source), ::testing::ElementsAre(0, 1, 2));
}

TEST_F(OpenSource, OpensAnEurocFolderCalibratedByACamchainOfSixteenBits) {
  const TinyDataset tiny{.frames = 3};
  for (const char* camera : {"cam0", "cam1"}) {
    remove_path(euroc_ + "/mav0/" + camera + "/sensor.yaml");
    for (int k = 0; k < tiny.frames; ++k) {
      write_image16(euroc_ + "/mav0/" + camera + "/data/" + euroc_image_name(k),
                    tiny_image(tiny, k, camera == std::string("cam1")));
    }
  }
  write_text(euroc_ + "/dso/camchain.yaml", tiny_camchain(tiny));
  const auto recording = open_source(euroc_, {});
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->calibration_path, euroc_ + "/dso/camchain.yaml");
  EXPECT_THAT(play(*recording->source), ::testing::ElementsAre(0, 1, 2));
}

TEST_F(OpenSource, PrefersTheTruthInEurocsOwnPlace) {
  write_text(euroc_ + "/mav0/state_groundtruth_estimate0/data.csv", "#timestamp\n");
  const auto recording = open_source(euroc_, {});
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->truth_path, euroc_ + "/mav0/state_groundtruth_estimate0/data.csv");
}

TEST_F(OpenSource, HasNoTruthWhereTheRecordingCarriesNone) {
  remove_path(kitti_ + "/poses.txt");
  const auto recording = open_source(kitti_, {});
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->truth_path, "");
  EXPECT_FALSE(recording->truth);
}

TEST_F(OpenSource, OpensASyntheticSceneWithItsTruth) {
  const auto recording = open_source("synthetic:mine,frames=5,width=64", {});
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->kind, "synthetic");
  EXPECT_EQ(recording->name, "mine");
  EXPECT_EQ(recording->frame_count, 5);
  ASSERT_TRUE(recording->truth);
  EXPECT_EQ(recording->truth->poses.size(), 5u);
  EXPECT_EQ(recording->rig.left.width, 64);
}

TEST_F(OpenSource, SelectsFramesOfEveryKindOfSource) {
  const OpenOptions options{.first = 1, .last = 5, .stride = 2};
  for (const std::string& source : {kitti_, std::string("synthetic:mine,frames=8,width=64")}) {
    const auto recording = open_source(source, options);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->frame_count, 2);
    EXPECT_THAT(play(*recording->source), ::testing::ElementsAre(1, 3));
    EXPECT_EQ(recording->source->stats().delivered, 2);
  }
}

TEST_F(OpenSource, RefusesARangeBeyondTheEnd) {
  const OpenOptions options{.first = 100};
  expect_refused(kitti_, ExitCode::kUsage, {"frames from 100 on", "frames 0 to 5"}, options);
  expect_refused("synthetic:mine,frames=8,width=64", ExitCode::kUsage, {"frames 0 to 7"}, options);
}

TEST_F(OpenSource, SuggestsTheNeighbourOfAMissingPath) {
  expect_refused(folder_ / "kiti_tiny", ExitCode::kNoInput, {"did you mean " + kitti_ + "?"});
}

TEST_F(OpenSource, ListsWhatIsRecognisedForAMissingPath) {
  for (const char* name : {"nowhere/at/all", "", "frames.lcmlog"}) {
    const auto recording = open_source(name, {});
    ASSERT_FALSE(recording.has_value());
    EXPECT_THAT(recording.error().message, HasSubstr("KITTI folder"));
    EXPECT_THAT(recording.error().message, HasSubstr("EuRoC folder"));
    EXPECT_THAT(recording.error().message, HasSubstr("synthetic:SCENE"));
  }
  expect_refused("nowhere/at/all", ExitCode::kNoInput, {"no such file"});
}

TEST_F(OpenSource, RefusesAnEmptyFolder) {
  const TemporaryFolder empty;
  expect_refused(empty.path(), ExitCode::kNoInput, {empty.path(), "empty folder"});
}

TEST_F(OpenSource, RefusesAFolderOfSomethingElse) {
  const TemporaryFolder other;
  write_text(other / "holiday/beach.png", "x");
  expect_refused(other.path(), ExitCode::kBadInput, {"neither", "image_0", "mav0"});
}

TEST_F(OpenSource, RefusesAFile) {
  const TemporaryFolder other;
  write_text(other / "notes.txt", "x");
  expect_refused(other / "notes.txt", ExitCode::kBadInput, {"is a file"});
}

TEST_F(OpenSource, NamesTheRecordingWhenAPartOfItIsGiven) {
  const std::string root = std::filesystem::canonical(folder_.path()).string();
  for (const char* part : {"/mav0", "/mav0/cam0", "/mav0/cam0/data", "/mav0/cam0/data.csv"}) {
    expect_refused(euroc_ + part, ExitCode::kBadInput, {"did you mean " + root + "/euroc_tiny?"});
  }
  expect_refused(kitti_ + "/image_0", ExitCode::kBadInput,
                 {"did you mean " + root + "/kitti_tiny?"});
}

TEST_F(OpenSource, NamesTheRecordingsInAFolderThatHoldsSome) {
  expect_refused(folder_.path(), ExitCode::kBadInput, {"holds 2", kitti_, euroc_});
}

TEST_F(OpenSource, RefusesAKittiFolderWithOneEye) {
  remove_path(kitti_ + "/image_1");
  expect_refused(kitti_, ExitCode::kNoInput, {"has no image_1"});
}

TEST_F(OpenSource, SaysThatColourCamerasAreNotPlayed) {
  std::filesystem::rename(kitti_ + "/image_0", kitti_ + "/image_2");
  std::filesystem::rename(kitti_ + "/image_1", kitti_ + "/image_3");
  expect_refused(kitti_, ExitCode::kNoInput, {"has no image_0", "colour cameras"});
}

TEST_F(OpenSource, RefusesAnEurocFolderWithOneEye) {
  remove_path(euroc_ + "/mav0/cam1");
  expect_refused(euroc_, ExitCode::kNoInput, {"mav0/cam1/data.csv", "not found"});
}

TEST_F(OpenSource, RefusesARecordingWithoutCalibration) {
  remove_path(kitti_ + "/calib.txt");
  expect_refused(kitti_, ExitCode::kConfiguration, {"calib.txt"});
  remove_path(euroc_ + "/mav0/cam0/sensor.yaml");
  expect_refused(euroc_, ExitCode::kConfiguration, {"cam0/sensor.yaml", "camchain"});
}

TEST_F(OpenSource, RefusesEyesOfDifferentCounts) {
  remove_path(kitti_ + "/image_1/" + kitti_image_name(5));
  expect_refused(kitti_, ExitCode::kBadInput, {"6 images", "image_1 5"});
}

TEST_F(OpenSource, RefusesEyesOfDifferentSizes) {
  const TinyDataset other{.width = 80, .height = 60};
  for (int k = 0; k < 6; ++k) {
    write_image(kitti_ + "/image_1/" + kitti_image_name(k), tiny_image(other, k, true));
  }
  expect_refused(kitti_, ExitCode::kBadInput, {"96x64", "80x60"});
}

TEST_F(OpenSource, RefusesImagesOfAnotherSizeThanTheCalibration) {
  for (const char* camera : {"cam0", "cam1"}) {
    replace_in_file(euroc_ + "/mav0/" + camera + "/sensor.yaml", "[96, 64]", "[192, 128]");
  }
  expect_refused(euroc_, ExitCode::kConfiguration, {"96x64", "192x128", "sensor.yaml"});
}

TEST_F(OpenSource, OpensTheRealRecordings) {
  for (const char* name : {"kitti_06", "kitti_03", "euroc_mh01_a", "euroc_v101_static"}) {
    REQUIRE_RECORDING(path, name);
    const auto recording = open_source(path, {});
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_NE(recording->truth_path, "");
    const auto sequences = play(*recording->source);
    EXPECT_EQ(static_cast<std::int64_t>(sequences.size()), recording->frame_count);
    EXPECT_EQ(recording->source->stats().stamps_not_increasing, 0);
  }
}

TEST(ParseFrameRange, ReadsBothOpenEnds) {
  const auto both = parse_frame_range("10:20", {.stride = 3});
  ASSERT_TRUE(both) << both.error().message;
  EXPECT_EQ(both->first, 10);
  EXPECT_EQ(both->last, 20);
  EXPECT_EQ(both->stride, 3);
  EXPECT_EQ(parse_frame_range(":20", {})->first, 0);
  EXPECT_EQ(parse_frame_range("5:", {})->last, OpenOptions().last);
  EXPECT_EQ(parse_frame_range(":", {})->first, 0);
}

TEST(ParseFrameRange, RefusesWhatIsNoRange) {
  for (const char* text : {"", "5", "5:5", "9:3", "-3:5", "a:b", "1:2:3", "1.5:2"}) {
    const auto range = parse_frame_range(text, {});
    ASSERT_FALSE(range.has_value()) << text;
    EXPECT_EQ(range.error().code, ExitCode::kUsage);
    EXPECT_THAT(range.error().message, HasSubstr("A:B"));
  }
}

}  // namespace
}  // namespace darkling::test
