// SPDX-License-Identifier: Apache-2.0
// Files that a bad disk, a bad editor or a bad day made: whatever they hold, loading ends with a
// rig that check_rig() accepts or a message that names the file.
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/calibration.h"
#include "support/calibration_files.h"
#include "support/random.h"
#include "support/temporary_folder.h"
#include "support/tiny_dataset.h"

namespace darkling::test {
namespace {

constexpr int kMutations = 1000;  // of each seed file
constexpr ImageSize kSize{.width = 640, .height = 480};

// What YAML, numbers and matrices are made of, and what they are afraid of.
constexpr std::array kPieces = {"[",
                                "]",
                                "{",
                                "}",
                                ":",
                                "- ",
                                "&a ",
                                "*a",
                                "!!",
                                "\n",
                                " ",
                                "\t",
                                "%YAML",
                                "---",
                                "...",
                                "#",
                                "'",
                                "\"",
                                "|",
                                ">",
                                "?",
                                "1e308",
                                "-0.0",
                                "nan",
                                "inf",
                                "~",
                                "9999999999",
                                "\xff",
                                "\xef\xbb\xbf",
                                "<<: *a",
                                "0x10",
                                "\\u0000"};

std::size_t place_in(const std::string& text, Random& random) {
  return static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size())));
}

std::string mutated(std::string text, Random& random) {
  const int edits = random.integer(0, 1) == 0 ? 1 : random.integer(2, 4);
  for (int i = 0; i < edits && !text.empty(); ++i) {
    const std::size_t at = place_in(text, random);
    const std::size_t length = static_cast<std::size_t>(random.integer(1, 30));
    switch (random.integer(0, 5)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at,
                    kPieces.at(static_cast<std::size_t>(random.integer(0, kPieces.size() - 1))));
        break;
      case 3:
        text.insert(at, text.substr(place_in(text, random), length));
        break;
      case 4:
        text.insert(at, 1, static_cast<char>(random.integer(0, 255)));
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random.integer(0, 7)));
    }
  }
  return text;
}

class MutatedCalibration : public ::testing::Test {
 protected:
  // Loads `loaded` while `file`, which holds `seed`, is written over with mutations of it.
  static void expect_survival(const std::string& file, const std::string& loaded,
                              const std::string& seed) {
    Random random(20240229);
    int accepted = 0;
    for (int i = 0; i < kMutations; ++i) {
      write_text(file, mutated(seed, random));
      const auto rig = load_calibration(loaded, kSize);
      accepted += rig ? 1 : 0;
      if (rig) {
        EXPECT_TRUE(check_rig(*rig)) << "mutation " << i << ":\n" << read_text(file);
      } else {
        EXPECT_EQ(rig.error().code, ExitCode::kConfiguration);
        EXPECT_FALSE(rig.error().message.empty());
      }
    }
    // Both happen, or this tests nothing.
    EXPECT_GT(accepted, 0);
    EXPECT_LT(accepted, kMutations * 95 / 100);
    write_text(file, seed);
  }

  TemporaryFolder folder_;
};

TEST_F(MutatedCalibration, OfKalibrIsRefusedOrLoaded) {
  expect_survival(folder_ / "camchain.yaml", folder_ / "camchain.yaml", tiny_camchain());
}

TEST_F(MutatedCalibration, OfEurocIsRefusedOrLoaded) {
  write_tiny_euroc(folder_.path(), {.frames = 1});
  const std::string sensor = folder_ / "mav0/cam0/sensor.yaml";
  expect_survival(sensor, folder_.path(), read_text(sensor));
}

TEST_F(MutatedCalibration, OfKittiIsRefusedOrLoaded) {
  expect_survival(folder_ / "calib.txt", folder_ / "calib.txt",
                  "P0: 500 0 320 0 0 500 240 0 0 0 1 0\n"
                  "P1: 500 0 320 -60 0 500 240 0 0 0 1 0\n");
}

TEST_F(MutatedCalibration, OfOpencvIsRefusedOrLoaded) {
  write_text(folder_ / "intrinsics.yml", opencv_intrinsics());
  write_text(folder_ / "extrinsics.yml", opencv_extrinsics());
  expect_survival(folder_ / "intrinsics.yml", folder_.path(), opencv_intrinsics());
  expect_survival(folder_ / "extrinsics.yml", folder_.path(), opencv_extrinsics());
}

TEST_F(MutatedCalibration, OfRosIsRefusedOrLoaded) {
  write_text(folder_ / "left.yaml", ros_camera_info("left", 0.0));
  expect_survival(folder_ / "right.yaml", folder_.path(), ros_camera_info("right", -60.0));
}

}  // namespace
}  // namespace darkling::test
