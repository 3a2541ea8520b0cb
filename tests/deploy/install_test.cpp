// SPDX-License-Identifier: Apache-2.0
// What `cmake --install` puts in place, judged by the tools that will read it.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_program.h"

namespace darkling {
namespace {

using test::ProgramResult;
using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::string_view kUnits = "/lib/systemd/system/";

ProgramResult shell(const std::string& command) {
  return test::run_program({"/bin/sh", "-c", command});
}

bool is_installed(const std::string& tool) {
  return shell("command -v " + tool).status == 0;
}

class Install : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto run = test::run_program({DARKLING_CMAKE, "--install", DARKLING_BUILD_DIR,
                                        "--component", "service", "--prefix", prefix_});
    ASSERT_EQ(run.status, 0) << run.err;
  }

  [[nodiscard]] std::string installed(std::string_view path) const {
    return prefix_ + std::string(path);
  }

  TemporaryFolder folder_;
  std::string prefix_ = folder_ / "usr";
};

TEST_F(Install, PutsEachFileWhereItIsLookedFor) {
  for (const char* path : {"/bin/darklingd", "/lib/systemd/system/darklingd.service",
                           "/lib/systemd/system/darkling-lcm-route.service",
                           "/lib/udev/rules.d/60-darkling.rules", "/lib/sysusers.d/darkling.conf",
                           "/share/darkling/darkling.yaml.example", "/share/doc/darkling/deploy.md",
                           "/share/man/man8/darklingd.8", "/share/man/man5/darkling.yaml.5"}) {
    EXPECT_TRUE(std::filesystem::is_regular_file(installed(path))) << path;
  }
}

TEST_F(Install, StagesBelowDestdirWithThePathsOfThePrefix) {
  const std::string stage = folder_ / "stage";
  const auto run = shell("DESTDIR='" + stage +
                         "' '" DARKLING_CMAKE "' --install '" DARKLING_BUILD_DIR
                         "' --component service --prefix /opt/darkling");
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string unit =
      test::read_text(stage + "/opt/darkling" + std::string(kUnits) + "darklingd.service");
  EXPECT_THAT(unit, HasSubstr("ExecStart=/opt/darkling/bin/darklingd --config "));
  EXPECT_THAT(unit, Not(HasSubstr("@CMAKE")));
}

TEST_F(Install, GivesUnitsWithoutAnUnknownKeyOrAMissingProgram) {
  if (!is_installed("systemd-analyze")) GTEST_SKIP() << "systemd-analyze is not installed";
  for (const char* unit : {"darklingd.service", "darkling-lcm-route.service"}) {
    // It ends with 0 although it found an unknown key; what it says counts.
    const auto run = shell("systemd-analyze verify '" + installed(kUnits) + unit + "'");
    EXPECT_EQ(run.status, 0) << unit;
    EXPECT_THAT(run.err, Not(HasSubstr(unit))) << unit;
  }
}

TEST_F(Install, WouldNoticeAnUnknownKey) {
  if (!is_installed("systemd-analyze")) GTEST_SKIP() << "systemd-analyze is not installed";
  const std::string unit = installed(kUnits) + "darklingd.service";
  test::replace_in_file(unit, "WatchdogSec=", "WatchDogSeconds=");
  EXPECT_THAT(shell("systemd-analyze verify '" + unit + "'").err, HasSubstr("darklingd.service"));
}

TEST_F(Install, GivesAUnitThatIsExposedLittle) {
  if (!is_installed("systemd-analyze")) GTEST_SKIP() << "systemd-analyze is not installed";
  const auto security = [this] {
    return shell("systemd-analyze security --offline=true --threshold=25 --no-pager '" +
                 installed(kUnits) + "darklingd.service'");
  };
  const auto run = security();
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  test::replace_in_file(installed(kUnits) + "darklingd.service", "CapabilityBoundingSet=\n", "");
  EXPECT_NE(security().status, 0) << "the limit refuses nothing";
}

TEST_F(Install, MakesAUserInTheGroupOfTheCameras) {
  if (!is_installed("systemd-sysusers")) GTEST_SKIP() << "systemd-sysusers is not installed";
  const auto run = shell("systemd-sysusers --dry-run --root='" + folder_.path() + "' '" +
                         installed("/lib/sysusers.d/darkling.conf") + "'");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out + run.err, HasSubstr("user 'darkling'"));
  EXPECT_THAT(run.out + run.err, HasSubstr("group 'video'"));
}

}  // namespace
}  // namespace darkling
