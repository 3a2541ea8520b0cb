// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darkling.h"
#include "io/trajectory.h"
#include "support/random_walk.h"

namespace darkling {
namespace {

using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Eval : public ::testing::Test {
 protected:
  Eval() {
    const auto walk = test::random_walk(2, 90, 0.4, 0.01);
    write_kitti(truth_, walk.truth);
    write_kitti(estimate_, walk.estimate);
  }

  static void write_kitti(const std::string& path, const std::vector<Se3>& poses) {
    std::string rows;
    for (const Se3& T : poses) rows += format_kitti_row(T);
    test::write_text(path, rows);
  }

  test::TemporaryFolder folder_;
  std::string truth_ = folder_ / "truth.txt";
  std::string estimate_ = folder_ / "estimate.txt";
};

TEST_F(Eval, PrintsATable) {
  const auto run = run_darkling({"eval", truth_, estimate_});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, AllOf(HasSubstr("0.95 %, 0.0920 deg/m"), HasSubstr("0.0350 m"),
                             HasSubstr("0.01030 m, 0.2760 deg a frame"), HasSubstr("90 matched")));
}

TEST_F(Eval, PrintsJson) {
  const auto run = run_darkling({"eval", truth_, estimate_, "--json"});
  EXPECT_EQ(run.status, 0);
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_NEAR(json["drift_percent"].get<double>(), 0.9508738781617083, 1e-9);
  EXPECT_NEAR(json["ate_rmse_m"].get<double>(), 0.03504345190295595, 1e-9);
}

TEST_F(Eval, RefusesToMixFormats) {
  const std::string tum = folder_ / "estimate.tum";
  test::write_text(tum, "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  const auto run = run_darkling({"eval", truth_, tum});
  EXPECT_EQ(run.status, 65);
  EXPECT_THAT(run.err, AllOf(HasSubstr("KITTI"), HasSubstr("TUM")));
}

TEST_F(Eval, SaysWhichFileIsAbsentOrMalformed) {
  EXPECT_EQ(run_darkling({"eval", truth_, folder_ / "absent"}).status, 66);
  test::replace_in_file(estimate_, "\n", " 7\n");
  const auto run = run_darkling({"eval", truth_, estimate_});
  EXPECT_EQ(run.status, 65);
  EXPECT_THAT(run.err, HasSubstr("estimate.txt:1: 13 columns"));
}

}  // namespace
}  // namespace darkling
