// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace darkling {

// The device nodes of "v4l2:/dev/video0" or "v4l2:/dev/video0,/dev/video1": one or two, absolute,
// different.
// @return kUsage with what was found and what is allowed.
[[nodiscard]] Result<std::vector<std::string>> parse_v4l2(std::string_view text);

}  // namespace darkling
