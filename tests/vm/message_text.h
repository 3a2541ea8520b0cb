// SPDX-License-Identifier: Apache-2.0
// Messages as text that shell scripts can read and ask about.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "messages/pose_t.hpp"
#include "messages/status_t.hpp"
#include "messages/update_t.hpp"

namespace darkling::test {

// Key and value; enumerations by name, vectors as "x,y,z", texts with `_` for spaces.
using Fields = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] Fields fields_of(const update_t& update);
[[nodiscard]] Fields fields_of(const pose_t& pose);
[[nodiscard]] Fields fields_of(const status_t& status);

struct Condition {
  std::string key;
  std::string comparison;  // "=", "!=", "<" or ">"
  std::string value;
};

// Throws std::invalid_argument when `text` is no condition.
[[nodiscard]] Condition parse_condition(const std::string& text);
// Throws std::invalid_argument for a key that is not there, so that no misspelt one is waited for.
[[nodiscard]] bool meets_all(const Fields& fields, const std::vector<Condition>& conditions);

}  // namespace darkling::test
