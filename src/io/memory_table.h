// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vo/memory_map.h"

namespace darkling {

// Every buffer with its size, who writes and who reads it, for a person to add up; the total, the
// budget for a thumbnail of this size, and the bound of the stack below.
[[nodiscard]] std::string format_memory_table(const MemoryMap& map, int width_px, int height_px);

}  // namespace darkling
