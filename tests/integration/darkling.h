// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace darkling::test {

// `darkling` as built, with these words behind it.
[[nodiscard]] inline std::vector<std::string> darkling_words(std::vector<std::string> words) {
  words.insert(words.begin(), DARKLING_PROGRAM);
  return words;
}

[[nodiscard]] inline ProgramResult run_darkling(const std::vector<std::string>& words) {
  return run_program(darkling_words(words));
}

[[nodiscard]] inline nlohmann::json read_json(const std::string& path) {
  return nlohmann::json::parse(read_text(path));
}

[[nodiscard]] inline std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace darkling::test
