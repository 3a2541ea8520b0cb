// SPDX-License-Identifier: Apache-2.0
#include "io/config.h"

#include <cmath>
#include <cstdlib>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/project_folder.h"
#include "support/temporary_folder.h"

namespace darkling {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Result<Config> load_content(const std::string& content) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "rover.yaml", content);
  return load_config(folder / "rover.yaml", {});
}

Result<Config> load_setting(const std::string& setting) {
  return load_config("", {{"--set", setting}});
}

void expect_refused(const Result<Config>& config, ExitCode code, const std::string& part) {
  ASSERT_FALSE(config) << part;
  EXPECT_EQ(config.error().code, code);
  EXPECT_THAT(config.error().message, HasSubstr(part));
}

TEST(LoadConfig, GivesTheDefaultsWhenNothingIsSet) {
  const auto config = load_config("", {});
  ASSERT_TRUE(config);
  EXPECT_EQ(format_config(*config), format_config(Config{}));
}

TEST(LoadConfig, ReadsAFileThenTheSettings) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "rover.yaml", "# mine\nwidth_px: 240\npoints_per_level: 700\n");
  const auto config = load_config(folder / "rover.yaml", {{"--set", "width_px=188"}});
  ASSERT_TRUE(config) << config.error().message;
  EXPECT_EQ(config->odometry.width_px, 188);
  EXPECT_EQ(config->odometry.points_per_level, 700);
}

TEST(LoadConfig, TakesAnEmptyFileForTheDefaults) {
  EXPECT_TRUE(load_content(""));
  EXPECT_TRUE(load_content("# nothing to change\n"));
}

TEST(LoadConfig, NamesFileLineAndNearestOfAnUnknownKey) {
  expect_refused(load_content("points_per_level: 700\nwidht_px: 240\n"), ExitCode::kConfiguration,
                 "rover.yaml:2: unknown key 'widht_px', did you mean 'width_px'?");
  expect_refused(load_setting("widht_px=240"), ExitCode::kUsage,
                 "--set: unknown key 'widht_px', did you mean 'width_px'?");
}

TEST(LoadConfig, RefusesAKeyGivenTwice) {
  expect_refused(load_content("width_px: 240\nwidth_px: 241\n"), ExitCode::kConfiguration,
                 "rover.yaml:2: key 'width_px' is given twice");
  expect_refused(load_config("", {{"--set", "width_px=240"}, {"--width", "width_px=240"}}),
                 ExitCode::kUsage, "--width: key 'width_px' is given twice");
}

TEST(LoadConfig, SaysWhatIsAllowedOfAValueOutOfRange) {
  expect_refused(load_content("width_px: 20\n"), ExitCode::kConfiguration,
                 "rover.yaml:1: key 'width_px': found '20', allowed is 64 to 1280 px or 0 "
                 "(kMinWidth, kMaxWidth)");
  expect_refused(load_setting("width_px=1281"), ExitCode::kUsage, "allowed is 64 to 1280 px or 0");
  expect_refused(load_setting("width_px=-1"), ExitCode::kUsage, "found '-1'");
  EXPECT_TRUE(load_setting("width_px=0"));
  EXPECT_TRUE(load_setting("width_px=64"));
  EXPECT_TRUE(load_setting("width_px=1280"));
}

TEST(LoadConfig, RefusesValuesOfAnotherKind) {
  for (const char* value : {"", "wide", "240.5", "240px", "[240]", "{a: 1}", "0x100", "nan"}) {
    expect_refused(load_content("width_px: " + std::string(value) + "\n"), ExitCode::kConfiguration,
                   "rover.yaml:1: key 'width_px'");
  }
}

TEST(LoadConfig, TakesTheWordsOfAnEnumeration) {
  EXPECT_EQ(OdometryConfig{}.stereo, StereoMethod::kSemiGlobal);
  EXPECT_EQ(load_content("stereo: block\n")->odometry.stereo, StereoMethod::kBlock);
  EXPECT_EQ(load_setting("stereo=block")->odometry.stereo, StereoMethod::kBlock);
  EXPECT_EQ(OdometryConfig{}.descriptor, Descriptor::kBitplanes);
  EXPECT_EQ(load_setting("descriptor=intensity")->odometry.descriptor, Descriptor::kIntensity);
  EXPECT_EQ(load_setting("stereo=semi_global")->odometry.stereo, StereoMethod::kSemiGlobal);
}

TEST(LoadConfig, ListsTheWordsAndSuggestsOneInPlaceOfAnother) {
  expect_refused(load_content("stereo: blokc\n"), ExitCode::kConfiguration,
                 "rover.yaml:1: key 'stereo': found 'blokc', allowed is semi_global or block, did "
                 "you mean 'block'?");
  expect_refused(
      load_setting("descriptor=intensty"), ExitCode::kUsage,
      "--set: key 'descriptor': found 'intensty', allowed is bitplanes or intensity, did "
      "you mean 'intensity'?");
  for (const char* value : {"", "1", "true", "[block]", "{a: block}", "BLOCK", "block "}) {
    expect_refused(load_setting("stereo=" + std::string(value)), ExitCode::kUsage,
                   "allowed is semi_global or block");
  }
  const auto unlike = load_setting("stereo=1");
  ASSERT_FALSE(unlike);
  EXPECT_THAT(unlike.error().message, Not(HasSubstr("did you mean")));
}

TEST(LoadConfig, TakesTextsAsTheyAreButNoControlCharacters) {
  EXPECT_EQ(load_setting("camera=v4l2:/dev/video0,/dev/video1")->camera.source,
            "v4l2:/dev/video0,/dev/video1");
  EXPECT_EQ(load_content("channel_prefix:\n")->service.channel_prefix, "");
  EXPECT_EQ(load_content("channel_prefix: 12\n")->service.channel_prefix, "12");
  expect_refused(load_content("channel_prefix: \"a\\nb\"\n"), ExitCode::kConfiguration,
                 "rover.yaml:1: key 'channel_prefix'");
  const std::string longest(53, 'x');  // LCM's 63 less "VO_COMMAND"
  EXPECT_EQ(load_setting("channel_prefix=" + longest)->service.channel_prefix, longest);
  expect_refused(load_setting("channel_prefix=" + longest + "x"), ExitCode::kUsage,
                 "text of up to 53 characters");
  expect_refused(load_content("camera: [a, b]\n"), ExitCode::kConfiguration, "a list or a map");
}

TEST(LoadConfig, RefusesASettingWithoutAnEqualsSign) {
  expect_refused(load_setting("width_px"), ExitCode::kUsage, "key=value is needed");
}

TEST(LoadConfig, RefusesWhatIsNoMapOfKeys) {
  expect_refused(load_content("- width_px\n"), ExitCode::kConfiguration, "a map of");
  expect_refused(load_content("a: [1\n"), ExitCode::kConfiguration, "is not valid YAML");
}

TEST(LoadConfig, SaysWhichFileCannotBeRead) {
  const test::TemporaryFolder folder;
  expect_refused(load_config(folder / "absent.yaml", {}), ExitCode::kNoInput,
                 "absent.yaml: configuration cannot be read: No such file");
  expect_refused(load_config(folder.path(), {}), ExitCode::kNoInput, "Is a directory");
}

TEST(ConfigKeys, AreNamedOnceAndHaveTheirDefaultsInRange) {
  std::set<std::string_view> names;
  for (const ConfigKey& key : config_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_FALSE(key.about.empty()) << key.name;
    EXPECT_LE(key.least, key.most) << key.name;
  }
  EXPECT_TRUE(load_content(format_config(Config{})));
}

TEST(FormatConfig, IsReadBackAsTheSameConfiguration) {
  Config config;
  config.odometry.width_px = 177;
  config.odometry.points_per_level = 321;
  config.odometry.descriptor = Descriptor::kIntensity;
  config.odometry.stereo = StereoMethod::kBlock;
  config.camera.source = R"(synthetic:mine,"odd" \ # name)";
  config.camera.layout = EyeLayout::kTopBottom;
  config.camera.gain = 12.5;
  config.service.channel_prefix = "'ROVER: ";
  config.service.lock_memory = true;
  const auto read = load_content(format_config(config));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(format_config(*read), format_config(config));
  EXPECT_EQ(read->camera.source, config.camera.source);
  EXPECT_THAT(format_config(*read), HasSubstr("# Allowed: semi_global or block.\nstereo: block\n"));
}

// DARKLING_UPDATE=1 writes the file instead.
TEST(DefaultConfigFile, IsWhatTheTableSays) {
  const std::string path = test::project_folder() + "/config/default.yaml";
  if (std::getenv("DARKLING_UPDATE") != nullptr) {
    test::write_text(path, format_config(Config{}));
  }
  EXPECT_EQ(test::read_text(path), format_config(Config{}))
      << "run with DARKLING_UPDATE=1 to write it anew";
}

}  // namespace
}  // namespace darkling
