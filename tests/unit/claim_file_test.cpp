// SPDX-License-Identifier: Apache-2.0
#include "app/service/claim_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace darkling {
namespace {

using ::testing::HasSubstr;

TEST(ClaimFile, TakesTheNextNameWhereOneIsTaken) {
  const test::TemporaryFolder folder;
  const std::string start = folder / "run";
  EXPECT_EQ(claim_file(start, ".lcmlog"), start + ".lcmlog");
  test::write_text(start + ".lcmlog", "precious");
  EXPECT_EQ(claim_file(start, ".lcmlog"), start + "-2.lcmlog");
  EXPECT_EQ(claim_file(start, ".lcmlog"), start + "-3.lcmlog");
  EXPECT_EQ(test::read_text(start + ".lcmlog"), "precious");
}

TEST(ClaimFile, GivesUpWhenAllAreTaken) {
  const test::TemporaryFolder folder;
  const std::string start = folder / "run";
  for (int i = 0; i < kMostOfOneName; ++i) ASSERT_TRUE(claim_file(start, ".lcmlog"));
  const auto refused = claim_file(start, ".lcmlog");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ExitCode::kUsage);
  EXPECT_THAT(refused.error().message, HasSubstr(start + "-99.lcmlog"));
}

TEST(ClaimFile, SaysWhyItCannot) {
  const test::TemporaryFolder folder;
  const auto refused = claim_file(folder / "no/run", ".lcmlog");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            folder / "no/run.lcmlog" + ": cannot be opened for writing: No such file or directory");
}

}  // namespace
}  // namespace darkling
