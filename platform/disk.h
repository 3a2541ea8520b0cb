// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "base/result.h"

namespace darkling {

// What this user can still write in `folder`, in bytes.
// @return kConfiguration when it is absent, no folder, or may not be written in.
[[nodiscard]] Result<std::uint64_t> read_free_bytes(const std::string& folder);

}  // namespace darkling
