// SPDX-License-Identifier: Apache-2.0
#include "io/config.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <set>

#include <yaml-cpp/yaml.h>

#include "base/nearest.h"
#include "base/text_file.h"

namespace darkling {

namespace {

// Shortest text that reads back as the same number.
std::string to_text(double value) {
  char text[32];
  const auto written = std::to_chars(text, text + sizeof(text), value);
  return {text, written.ptr};
}

std::string join_with_or(std::span<const std::string_view> words) {
  std::string joined(words.front());
  for (const std::string_view word : words.subspan(1)) joined.append(" or ").append(word);
  return joined;
}

std::string describe_range(const ConfigKey& key) {
  if (const auto* field = std::get_if<WordField>(&key.field)) return join_with_or(field->words);
  if (std::holds_alternative<bool OdometryConfig::*>(key.field)) return "true or false";
  std::string range = to_text(key.least) + " to " + to_text(key.most);
  if (!key.unit.empty()) range.append(" ").append(key.unit);
  if (key.may_be_zero) range += " or 0";
  return range;
}

std::string describe_limits(const ConfigKey& key) {
  return key.limits.empty() ? "" : " (" + std::string(key.limits) + ")";
}

std::string suggest_word(const ConfigKey& key, std::string_view found) {
  const auto* field = std::get_if<WordField>(&key.field);
  const auto nearest = field != nullptr ? nearest_name(found, field->words) : std::nullopt;
  return nearest ? ", did you mean '" + std::string(*nearest) + "'?" : "";
}

// What one key of `config` is, as the file would say it.
std::string value_text(const OdometryConfig& config, const ConfigKey& key) {
  if (const auto* field = std::get_if<WordField>(&key.field)) {
    return std::string(field->words[field->get(config)]);
  }
  if (const auto* field = std::get_if<bool OdometryConfig::*>(&key.field)) {
    return config.**field ? "true" : "false";
  }
  if (const auto* field = std::get_if<int OdometryConfig::*>(&key.field)) {
    return std::to_string(config.**field);
  }
  return to_text(config.*std::get<double OdometryConfig::*>(key.field));
}

bool is_allowed(const ConfigKey& key, double value) {
  return (value >= key.least && value <= key.most) || (key.may_be_zero && value == 0.0);
}

bool set_word(OdometryConfig& config, const WordField& field, std::string_view text) {
  const auto word = std::find(field.words.begin(), field.words.end(), text);
  if (word == field.words.end()) return false;
  field.set(config, static_cast<std::size_t>(word - field.words.begin()));
  return true;
}

// @return false when `text` is not a value of the key's type and range.
bool set_value(OdometryConfig& config, const ConfigKey& key, std::string_view text) {
  if (const auto* field = std::get_if<WordField>(&key.field)) return set_word(config, *field, text);
  if (const auto* field = std::get_if<bool OdometryConfig::*>(&key.field)) {
    config.** field = text == "true";
    return text == "true" || text == "false";
  }
  if (const auto* field = std::get_if<int OdometryConfig::*>(&key.field)) {
    const auto value = parse_number<int>(text);
    if (!value || !is_allowed(key, *value)) return false;
    config.** field = *value;
    return true;
  }
  const auto value = parse_number<double>(text);
  if (!value || !is_allowed(key, *value)) return false;
  config.*std::get<double OdometryConfig::*>(key.field) = *value;
  return true;
}

const ConfigKey* find_key(std::string_view name) {
  for (const ConfigKey& key : config_keys()) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

std::string unknown_key(std::string_view name) {
  std::vector<std::string_view> names;
  for (const ConfigKey& key : config_keys()) names.push_back(key.name);
  return "unknown key '" + std::string(name) + "'" + did_you_mean(name, names);
}

// One place that keys come from: knows which it has set, and how to complain.
class Setter {
 public:
  Setter(OdometryConfig& config, ExitCode code) : config_(config), code_(code) {}

  Result<void> set(const std::string& where, std::string_view name, std::string_view value) {
    const ConfigKey* key = find_key(name);
    if (key == nullptr) return failure(code_, where + unknown_key(name));
    if (!seen_.insert(key).second) {
      return failure(code_, where + "key '" + std::string(name) + "' is given twice");
    }
    if (!set_value(config_, *key, value)) {
      return failure(code_, where + "key '" + std::string(name) + "': found '" +
                                std::string(value) + "', allowed is " + describe_range(*key) +
                                describe_limits(*key) + suggest_word(*key, value));
    }
    return {};
  }

 private:
  OdometryConfig& config_;
  ExitCode code_;
  std::set<const ConfigKey*> seen_;
};

Result<void> set_from_yaml(const std::string& path, const YAML::Node& top, Setter& setter) {
  if (top.IsNull()) return {};
  if (!top.IsMap()) {
    return failure(ExitCode::kConfiguration, path + ": a map of `key: value` lines is needed");
  }
  for (const auto& entry : top) {
    const std::string where = at_line(path, entry.first.Mark().line + 1);
    if (!entry.first.IsScalar()) {
      return failure(ExitCode::kConfiguration, where + "a key must be one word");
    }
    const std::string name = entry.first.Scalar();
    const bool is_scalar = entry.second.IsScalar();
    const auto set = setter.set(where, name, is_scalar ? entry.second.Scalar() : "");
    if (!set) return set;
  }
  return {};
}

Result<void> set_from_file(const std::string& path, Setter& setter) {
  std::ifstream file(path);
  std::string content;
  for (std::string line; std::getline(file, line);) content += line + '\n';
  if (!file.is_open() || file.bad()) {
    return failure(ExitCode::kNoInput,
                   path + ": configuration cannot be read: " + std::strerror(errno));
  }
  try {
    return set_from_yaml(path, YAML::Load(content), setter);
  } catch (const YAML::Exception& e) {
    return failure(ExitCode::kConfiguration,
                   at_line(path, e.mark.line + 1) + "is not valid YAML: " + e.msg);
  }
}

}  // namespace

Result<OdometryConfig> load_config(const std::string& path,
                                   const std::vector<ConfigSetting>& settings) {
  OdometryConfig config;
  if (!path.empty()) {
    Setter setter(config, ExitCode::kConfiguration);
    const auto read = set_from_file(path, setter);
    if (!read) return tl::unexpected(read.error());
  }
  Setter setter(config, ExitCode::kUsage);
  for (const auto& [option, text] : settings) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
      return failure(ExitCode::kUsage, option + ": found '" + text + "', key=value is needed");
    }
    const auto set = setter.set(option + ": ", text.substr(0, equals), text.substr(equals + 1));
    if (!set) return tl::unexpected(set.error());
  }
  return config;
}

std::string format_config(const OdometryConfig& config) {
  std::string file =
      "# Configuration of Darkling: every key there is. One that is left out has its default.\n";
  for (const ConfigKey& key : config_keys()) {
    file += "\n# " + std::string(key.about) + "\n# Allowed: " + describe_range(key) + ".\n" +
            std::string(key.name) + ": " + value_text(config, key) + "\n";
  }
  return file;
}

}  // namespace darkling
