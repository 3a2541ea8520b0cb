// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace darkling {

// The most memory this process has had resident, in bytes; nothing where the system does not tell.
[[nodiscard]] std::optional<std::int64_t> read_peak_rss_bytes();

// What it has resident now. Without a heap call.
[[nodiscard]] std::optional<std::int64_t> read_rss_bytes();

// Gives back to the system what was freed and is kept for the next allocation. At start-up only: it
// takes milliseconds.
void return_free_memory();

}  // namespace darkling
