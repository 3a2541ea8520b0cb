// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace darkling {

// The fewest insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
[[nodiscard]] int edit_distance(std::string_view a, std::string_view b);

// The name most like `word`, the first of equals; nothing where none is alike: more than half of
// the longer of the two would have to change.
[[nodiscard]] std::optional<std::string_view> nearest_name(std::string_view word,
                                                           std::span<const std::string_view> names);

// What to append to "unknown option 'word'": ", did you mean 'nearest'?" or, where no name is
// alike,
// "; known are a, b, c".
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       std::span<const std::string_view> names);

// "a, b, c".
[[nodiscard]] std::string join_names(std::span<const std::string_view> names);

}  // namespace darkling
