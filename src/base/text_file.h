// SPDX-License-Identifier: Apache-2.0
// Small text files that people and other programs write: read once, at start-up, with line numbers
// for the messages.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/result.h"

namespace darkling {

struct TextLine {
  int number = 0;    // counted from 1, as editors do
  std::string text;  // without white space at either end, hence without '\r'
};

// The lines of `path` that are neither blank nor comments ('#').
// @return kNoInput when it cannot be read, with the system's reason.
[[nodiscard]] Result<std::vector<TextLine>> read_text_lines(const std::string& path);

// "PATH:LINE: " as compilers write it, to start a message with.
[[nodiscard]] std::string at_line(const std::string& path, int line);

[[nodiscard]] std::string_view trim(std::string_view text);

// The pieces between `separator`s, trimmed; a space as the separator stands for any white space,
// and then no piece is empty.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

// The number that is all of `text` (whatever the locale), or nothing. Accepts "nan" and "inf": ask
// std::isfinite().
template <class Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

}  // namespace darkling
