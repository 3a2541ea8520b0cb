// SPDX-License-Identifier: Apache-2.0
// The programs that measure the service understand their words, or say what is wrong, before they
// measure anything.
#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_program.h"

namespace darkling {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Program {
  const char* path;
  const char* name;
};
constexpr std::array kPrograms = {Program{LONG_RUN_PROGRAM, "long_run"},
                                  Program{MEASURE_SERVICE_PROGRAM, "measure_service"}};

void expect_usage_error(const std::vector<std::string>& words, const std::string& message_part) {
  const auto run = test::run_program(words);
  EXPECT_EQ(run.status, 64) << message_part;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, AllOf(HasSubstr(message_part), HasSubstr("--help")));
}

TEST(BenchPrograms, TeachInTheirHelpAndMeasureNothing) {
  for (const Program& program : kPrograms) {
    const auto run = test::run_program({program.path, "--help"});
    EXPECT_EQ(run.status, 0) << program.name;
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(run.out, AllOf(HasSubstr("Examples:"), HasSubstr("Exit codes:"),
                               HasSubstr(std::string("Usage: ") + program.name)));
    EXPECT_THAT(run.out, Not(HasSubstr("passed over 0")));
  }
}

TEST(BenchPrograms, RefuseUnknownWords) {
  for (const Program& program : kPrograms) {
    expect_usage_error({program.path, "1000"}, "1000");
    expect_usage_error({program.path, "--farmes", "10"}, "--farmes");
  }
}

TEST(LongRun, RefusesNumbersThatAreNone) {
  for (const char* frames : {"0", "-5", "many", "1e3", "99999999999999999999"}) {
    expect_usage_error({LONG_RUN_PROGRAM, "--frames", frames}, "--frames");
  }
  for (const char* width : {"63", "1281", "wide"}) {
    expect_usage_error({LONG_RUN_PROGRAM, "--width", width}, "--width");
  }
}

TEST(MeasureService, RefusesTimesThatAreNone) {
  for (const char* seconds : {"0", "-1", "nan", "soon"}) {
    expect_usage_error({MEASURE_SERVICE_PROGRAM, "--for", seconds}, "--for");
  }
}

TEST(LongRun, TracksAsManyFramesAsAskedForEvenWhenThoseAreFewerThanItsReports) {
  const auto run = test::run_program({LONG_RUN_PROGRAM, "--frames", "3", "--width", "64"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\n         3 "));
  EXPECT_THAT(run.out, HasSubstr("passed over 0, estimates not published 0"));
}

}  // namespace
}  // namespace darkling
