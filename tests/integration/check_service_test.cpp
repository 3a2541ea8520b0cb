// SPDX-License-Identifier: Apache-2.0
// The rows of `darkling check` that are about the service: its calibration, camera and machine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/synthetic/synthetic_rig.h"
#include "integration/darkling.h"
#include "support/calibration_files.h"
#include "support/temporary_folder.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;

// Of the cameras of `synthetic:mine,width=320`, as OpenCV would have written it.
std::string calibration_of_a_scene() {
  auto spec = parse_synthetic("synthetic:mine,width=320");
  EXPECT_TRUE(spec);
  return test::opencv_calibration(make_synthetic_rig(*spec));
}

TEST(CheckService, TakesEveryThingFromAConfiguration) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "rover.yaml", "camera: synthetic:mine,width=320\ncpu: 0\nrecord_to: " +
                                              folder.path() + "\nrecord_limit_mb: 1\n");
  const auto run = run_darkling({"check", "--config", folder / "rover.yaml"});
  EXPECT_THAT(
      run.out,
      AllOf(HasSubstr("calibration    ok: synthetic rig\n"),
            HasSubstr("rig            ok: baseline 0.12 m, images 320 x 240 px"),
            HasSubstr("camera         ok: synthetic:mine"), HasSubstr("image rows     ok: 0."),
            HasSubstr("core           ok: 0\n"), HasSubstr("recording      ok: " + folder.path())));
}

TEST(CheckService, HoldsTheConfiguredCalibrationAgainstImages) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "stereo.yml";
  test::write_text(path, calibration_of_a_scene());
  const auto good =
      run_darkling({"check", "--set", "calibration=" + path, "synthetic:mine,width=320,frames=5"});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out, AllOf(HasSubstr("calibration    ok: " + path + "\n"),
                              HasSubstr("image rows     ok: 0.")));
  // The same cameras after the right one was knocked.
  const auto knocked = run_darkling({"check", "--set", "calibration=" + path,
                                     "synthetic:mine,width=320,frames=5,roll_right_deg=2"});
  EXPECT_EQ(knocked.status, 78) << knocked.out;
  EXPECT_THAT(knocked.out, AllOf(HasSubstr("image rows     wrong: what both eyes see is "),
                                 HasSubstr("px apart"), HasSubstr("calibrate again")));
}

TEST(CheckService, RefusesACalibrationForImagesOfAnotherSize) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "stereo.yml", calibration_of_a_scene());
  const auto run = run_darkling({"check", "--set", "calibration=" + (folder / "stereo.yml"),
                                 "synthetic:mine,width=160,frames=5"});
  EXPECT_EQ(run.status, 78) << run.out;
  EXPECT_THAT(run.err,
              HasSubstr("the images are 160 x 120 px, the calibration is for 320 x 240 px"));
}

TEST(CheckService, PrintsEveryRowAndTheCodeOfTheFirstThatIsWrong) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "stereo.yml", calibration_of_a_scene());
  const auto run =
      run_darkling({"check", "--set", "calibration=" + (folder / "stereo.yml"), "--set",
                    "camera=v4l2:/dev/no-such-video", "--set", "lcm_url=carrier-pigeon", "--set",
                    "cpu=1023", "--set", "record_to=" + (folder / "absent")});
  EXPECT_EQ(run.status, 69) << run.out;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("calibration    ok: "),
                    HasSubstr("camera         wrong: /dev/no-such-video: there is no such device"),
                    HasSubstr("messages       wrong: key 'lcm_url': found 'carrier-pigeon'"),
                    HasSubstr("core           wrong: key 'cpu': found 1023, online and allowed"),
                    HasSubstr("recording      wrong: key 'record_to': ")));
  EXPECT_THAT(run.err, HasSubstr("/dev/no-such-video"));
}

TEST(CheckService, NeedsACalibrationForACamera) {
  const auto run = run_darkling({"check", "--set", "camera=v4l2:/dev/null"});
  EXPECT_EQ(run.status, 78) << run.out;
  EXPECT_THAT(run.out, AllOf(HasSubstr("calibration    wrong: key 'calibration': found nothing"),
                             HasSubstr("camera         wrong: /dev/null: this is no V4L2 device")));
}

TEST(CheckService, RefusesCamerasThatMakeNoSense) {
  for (const char* camera : {"/dev/video0", "v4l2:video0", "synthetic:moon", "absent.lcmlog"}) {
    const auto run = run_darkling({"check", "--set", std::string("camera=") + camera});
    EXPECT_NE(run.status, 0) << camera;
    EXPECT_THAT(run.out, HasSubstr("camera         wrong: ")) << camera;
  }
}

TEST(CheckService, RefusesACalibrationWithTheFilesNameAndKey) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "stereo.yml";
  test::write_text(path, calibration_of_a_scene());
  test::replace_in_file(path, "M2:", "M3:");
  const auto run = run_darkling({"check", "--set", "calibration=" + path});
  EXPECT_EQ(run.status, 78) << run.out;
  EXPECT_THAT(run.err, AllOf(HasSubstr("key 'calibration': " + path), HasSubstr("'M2'")));
}

}  // namespace
}  // namespace darkling
