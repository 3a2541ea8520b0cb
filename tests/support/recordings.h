// SPDX-License-Identifier: Apache-2.0
// Real recordings, which are not part of the project: tests that need one skip without it.
#pragma once

#include <string>

#include <gtest/gtest.h>

namespace darkling::test {

// $DARKLING_DATA, by default shared/data beside the project; it need not exist.
[[nodiscard]] std::string data_folder();

// The folder of the recording, or empty where it is absent.
[[nodiscard]] std::string recording_folder(const std::string& name);

}  // namespace darkling::test

// Declares `variable` as the recording's folder, or skips the test.
#define REQUIRE_RECORDING(variable, name)                                                          \
  const std::string variable = ::darkling::test::recording_folder(name);                           \
  if ((variable).empty()) {                                                                        \
    GTEST_SKIP() << "the recording " << (name) << " is not in " << ::darkling::test::data_folder() \
                 << "; DARKLING_DATA says where to look";                                          \
  }                                                                                                \
  static_assert(true, "ends in a semicolon")
