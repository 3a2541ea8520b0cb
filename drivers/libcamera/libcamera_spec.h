// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace darkling {

// The cameras of "libcamera:NAME" or "libcamera:NAME,NAME": one or two, different as written; what
// a name may be says find_camera().
// @return kUsage with what was found and what is allowed.
[[nodiscard]] Result<std::vector<std::string>> parse_libcamera(std::string_view text);

// The identifier that `name` means: one of `ids` itself, an end of exactly one of them, or the
// place of one in the list, from 0.
// @return kDeviceUnavailable with the identifiers there are.
[[nodiscard]] Result<std::string> find_camera(const std::string& name,
                                              const std::vector<std::string>& ids);

}  // namespace darkling
