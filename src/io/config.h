// SPDX-License-Identifier: Apache-2.0
// The configuration as a user sees it: named keys with unit, range and default, from a YAML file
// and from `key=value` words. One table in config_keys.cpp is all there is to say about a key.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/camera_config.h"
#include "base/result.h"
#include "vo/odometry_config.h"

namespace darkling {

// What only the service has: where it publishes, what it records, what it asks of the system.
struct ServiceConfig {
  std::string calibration;  // file or folder; empty: what a recording or a scene brings along
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string channel_prefix;
  bool bot_core_pose = false;  // besides, as bot_core.pose_t
  std::string record_to;       // folder for frame logs; empty: none can be made
  bool record = false;         // from the start
  int record_limit_mb = 2000;  // of one frame log
  double black_box_s = 0.0;    // kept in memory and written when tracking is lost; 0: none
  int realtime_priority = 0;   // SCHED_FIFO of the capture thread; 0: like any other
  int cpu = -1;                // core the odometry stays on; -1: any
  bool lock_memory = false;
};

struct Config {
  OdometryConfig odometry;
  CameraConfig camera;
  ServiceConfig service;
};

// A member of one of the parts of Config.
template <class T>
struct Field {
  const T& (*get)(const Config& config);
  T& (*edit)(Config& config);
};

// Of a key that is one of a few words: an enumeration, by its place in `words`.
struct WordField {
  std::span<const std::string_view> words;
  std::size_t (*get)(const Config& config);
  void (*set)(Config& config, std::size_t word);
};

struct ConfigKey {
  std::string_view name;
  std::string_view unit;  // of a number; empty for counts. Of a text: what it is
  double least;           // of a number
  double most;            // of a text: how many characters; 0: any number
  std::variant<Field<int>, Field<double>, Field<bool>, Field<std::string>, WordField> field;
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

// The defaults, then every key of the file, then every setting. Defaults are those of Config's
// parts.
// @param path  of a flat YAML map; empty for none.
// @return kNoInput when the file cannot be read, kConfiguration for what is wrong in it and kUsage
//         for what is wrong in a setting: a key that is unknown (the nearest known is named) or
//         comes twice, a value that is no number, out of range or none of the words. File and line
//         are named.
[[nodiscard]] Result<Config> load_config(const std::string& path,
                                         const std::vector<ConfigSetting>& settings);

// `config` as a file that load_config() reads back: every key with its unit, range and sentence.
[[nodiscard]] std::string format_config(const Config& config);

}  // namespace darkling
