// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace darkling {

// LCM takes the names of channels that are listened to for regular expressions; this one matches
// `text` and nothing else.
[[nodiscard]] inline std::string escape_channel(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("\\^$.|?*+()[]{}").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace darkling
