// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace darkling {

// Nanoseconds of a decimal number of seconds ("1403636584.66356", "1.5e3"), exactly: a double has
// only a quarter of a microsecond left at epoch seconds. Digits beyond the ninth are rounded.
// @return nothing when `seconds` is not a number or does not fit.
[[nodiscard]] std::optional<std::int64_t> ns_from_seconds_text(std::string_view seconds);

// Seconds with nine decimals.
[[nodiscard]] std::string seconds_text_from_ns(std::int64_t ns);

}  // namespace darkling
