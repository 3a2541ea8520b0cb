// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace darkling::test {

// The root of the source tree the tests were built from.
[[nodiscard]] std::string project_folder();

}  // namespace darkling::test
