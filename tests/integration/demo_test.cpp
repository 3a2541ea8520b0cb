// SPDX-License-Identifier: Apache-2.0
// What demo.sh does after building: its own command lines, run on the program under test.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"
#include "support/project_folder.h"

namespace darkling {
namespace {

// The lines of the script that start the program.
std::vector<std::string> demo_commands() {
  std::istringstream script(test::read_text(test::project_folder() + "/demo.sh"));
  std::vector<std::string> commands;
  for (std::string line; std::getline(script, line);) {
    const std::size_t start = line.find_first_not_of(' ');
    if (start != std::string::npos && line.compare(start, 12, "\"$darkling\" ") == 0) {
      commands.push_back(line.substr(start));
    }
  }
  return commands;
}

TEST(Demo, RendersAMineAndTracksItWithItsErrorAgainstTheTruth) {
  const std::vector<std::string> commands = demo_commands();
  ASSERT_EQ(commands.size(), 2u);
  const test::TemporaryFolder folder;
  const std::string out = folder / "mine";
  std::string printed;
  for (const std::string& command : commands) {
    const auto run = test::run_program(
        {"/bin/bash", "-c", "darkling='" DARKLING_PROGRAM "' out='" + out + "'; " + command});
    ASSERT_EQ(run.status, 0) << command << '\n' << run.err;
    printed = run.out;
  }
  EXPECT_THAT(printed, ::testing::HasSubstr("drift"));
  const auto json = test::read_json(out + ".json");
  EXPECT_EQ(json["frames"], 200);
  EXPECT_EQ(json["lost_frames"], 0);
  EXPECT_LE(json["drift_percent"], 0.6);
  EXPECT_EQ(test::count_lines(test::read_text(out + ".tum")), 200u);
}

}  // namespace
}  // namespace darkling
