// SPDX-License-Identifier: Apache-2.0
#include "app/check_system.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/disk.h"
#include "platform/limits.h"
#include "support/temporary_folder.h"

namespace darkling::test {
namespace {

using ::testing::HasSubstr;

CheckRow row_of(const std::string& name, const Config& config) {
  CheckRows rows;
  check_system(config, 0, rows);
  for (const CheckRow& row : rows.rows()) {
    if (row.name == name) return row;
  }
  ADD_FAILURE() << "no row " << name;
  return {};
}

TEST(CheckRows, GivesTheFirstThatIsWrong) {
  CheckRows rows;
  rows.ok("one", "well");
  rows.warning("two", "hm");
  EXPECT_FALSE(rows.first_wrong());
  rows.wrong("three", {ExitCode::kNoInput, "absent"});
  rows.wrong("four", {ExitCode::kBadInput, "bad"});
  ASSERT_TRUE(rows.first_wrong());
  EXPECT_EQ(rows.first_wrong()->code, ExitCode::kNoInput);
}

TEST(CheckRows, AreALineEachAndIndentWhatFollows) {
  CheckRows rows;
  rows.ok("one", "well");
  rows.not_checked("a name", "no need");
  rows.warning("two", "first\nsecond");
  EXPECT_EQ(format_rows(rows),
            "  one            ok: well\n"
            "  a name         not checked: no need\n"
            "  two            warning: first\n"
            "                 second\n");
}

TEST(CheckSystem, NeedsNothingThatNoKeyAsksFor) {
  for (const char* name : {"real time", "memory lock", "core", "recording"}) {
    EXPECT_EQ(row_of(name, {}).finding, Finding::kNotChecked) << name;
  }
}

TEST(CheckSystem, ComparesThePriorityWithTheUsersLimit) {
  Config config;
  config.service.realtime_priority = 1;
  const bool is_allowed = read_most_realtime_priority() >= 1;
  EXPECT_EQ(row_of("real time", config).finding, is_allowed ? Finding::kOk : Finding::kWrong);
}

TEST(CheckSystem, ComparesTheCoreWithThoseThatAreThere) {
  Config config;
  const std::vector<int> cores = read_allowed_cores();
  ASSERT_FALSE(cores.empty());
  EXPECT_TRUE(std::is_sorted(cores.begin(), cores.end()));
  config.service.cpu = cores.front();
  EXPECT_EQ(row_of("core", config).finding, Finding::kOk);
  config.service.cpu = cores.back() + 1;
  EXPECT_EQ(row_of("core", config).finding, Finding::kWrong);
}

TEST(CheckSystem, WantsAFolderWithRoomForRecordings) {
  const TemporaryFolder folder;
  Config config;
  config.service.record = true;
  EXPECT_THAT(row_of("recording", config).text, HasSubstr("a folder is needed"));
  config.service.record_to = folder / "absent";
  EXPECT_THAT(row_of("recording", config).text, HasSubstr("No such file"));
  write_text(folder / "file", "");
  config.service.record_to = folder / "file";
  EXPECT_THAT(row_of("recording", config).text, HasSubstr("is no folder"));
  config.service.record_to = folder.path();
  config.service.record_limit_mb = 1;
  EXPECT_EQ(row_of("recording", config).finding, Finding::kOk);
  const auto free_bytes = read_free_bytes(folder.path());
  ASSERT_TRUE(free_bytes);
  config.service.record_limit_mb =
      static_cast<int>(std::min<std::uint64_t>(2 * (*free_bytes / 1'000'000) + 10, 2'000'000'000));
  EXPECT_THAT(row_of("recording", config).text, HasSubstr("make room, or lower it"));
}

TEST(CheckSystem, RefusesAWayForMessagesThatIsNone) {
  Config config;
  config.service.lcm_url = "tcp://localhost";
  const CheckRow row = row_of("messages", config);
  EXPECT_EQ(row.finding, Finding::kWrong);
  EXPECT_EQ(row.code, ExitCode::kConfiguration);
}

TEST(CheckSystem, SaysHowToMakeARouteWhereMessagesHaveNone) {
  Config config;
  config.service.lcm_url = "udpm://no-group:7667?ttl=0";  // has no route anywhere
  EXPECT_EQ(row_of("messages", config).finding, Finding::kWarning);
  config.camera.source = "synthetic:mine";
  const CheckRow row = row_of("messages", config);
  EXPECT_EQ(row.finding, Finding::kWrong);
  EXPECT_THAT(row.text, HasSubstr("ip route add no-group/32 dev lo; ip link set lo multicast on"));
}

}  // namespace
}  // namespace darkling::test
