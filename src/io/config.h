// SPDX-License-Identifier: Apache-2.0
// The configuration as a user sees it: named keys with unit, range and default, from a YAML file
// and from `key=value` words. One table in config_keys.cpp is all there is to say about a key.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.h"
#include "vo/odometry_config.h"

namespace darkling {

// Of a key that is one of a few words: an enumeration of OdometryConfig, by its place in `words`.
struct WordField {
  std::span<const std::string_view> words;
  std::size_t (*get)(const OdometryConfig& config);
  void (*set)(OdometryConfig& config, std::size_t word);
};

struct ConfigKey {
  std::string_view name;
  std::string_view unit;  // empty for counts, switches and words
  double least;           // of a number
  double most;
  std::variant<int OdometryConfig::*, double OdometryConfig::*, bool OdometryConfig::*, WordField>
      field;
  std::string_view about;        // one sentence
  bool may_be_zero = false;      // besides the range: 0 has a meaning of its own
  std::string_view limits = "";  // that the range is made of, by their names in vo/limits.h
};

// A key given on the command line.
struct ConfigSetting {
  std::string option;  // that it came by, for messages: "--set"
  std::string text;    // "key=value"
};

[[nodiscard]] std::span<const ConfigKey> config_keys();

// The defaults, then every key of the file, then every setting. Defaults are OdometryConfig's own.
// @param path  of a flat YAML map; empty for none.
// @return kNoInput when the file cannot be read, kConfiguration for what is wrong in it and kUsage
//         for what is wrong in a setting: a key that is unknown (the nearest known is named) or
//         comes twice, a value that is no number, out of range or none of the words. File and line
//         are named.
[[nodiscard]] Result<OdometryConfig> load_config(const std::string& path,
                                                 const std::vector<ConfigSetting>& settings);

// `config` as a file that load_config() reads back: every key with its unit, range and sentence.
[[nodiscard]] std::string format_config(const OdometryConfig& config);

}  // namespace darkling
