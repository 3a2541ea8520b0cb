// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace darkling {

// How often this thread has called the allocator so far: malloc and all its relatives, free
// included, from whichever library; the difference of two readings is what lay between them.
// Nothing in a program that does not link the probe (`darkling_heap_probe`): sanitizers bring an
// allocator of their own.
// Thread: any; each has its own count. Cost: an addition a call.
[[nodiscard]] std::optional<std::int64_t> count_heap_calls();

}  // namespace darkling
