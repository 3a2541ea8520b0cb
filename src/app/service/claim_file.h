// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/result.h"

namespace darkling {

inline constexpr int kMostOfOneName = 99;

// Creates an empty file where there was none: START END, else START-2 END, START-3 END and so on up
// to kMostOfOneName. Of several who ask at once, each gets a file of its own.
// @return its path; kUsage with the system's reason, or when all of them exist.
[[nodiscard]] Result<std::string> claim_file(const std::string& start, const std::string& end);

}  // namespace darkling
