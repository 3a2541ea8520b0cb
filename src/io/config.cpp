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
  const auto written = std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed);
  return {text, written.ptr};
}

std::string join_with_or(std::span<const std::string_view> words) {
  std::string joined(words.front());
  for (const std::string_view word : words.subspan(1)) joined.append(" or ").append(word);
  return joined;
}

std::string describe_range(const ConfigKey& key) {
  if (const auto* field = std::get_if<WordField>(&key.field)) return join_with_or(field->words);
  if (std::holds_alternative<Field<bool>>(key.field)) return "true or false";
  if (std::holds_alternative<Field<std::string>>(key.field)) return std::string(key.unit);
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

// `text` as YAML reads it back, whatever is in it.
std::string quote(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

// What one key of `config` is, as the file would say it.
std::string value_text(const Config& config, const ConfigKey& key) {
  struct Visitor {
    const Config& config;
    std::string operator()(const Field<int>& f) const { return std::to_string(f.get(config)); }
    std::string operator()(const Field<double>& f) const { return to_text(f.get(config)); }
    std::string operator()(const Field<bool>& f) const { return f.get(config) ? "true" : "false"; }
    std::string operator()(const Field<std::string>& f) const { return quote(f.get(config)); }
    std::string operator()(const WordField& f) const { return std::string(f.words[f.get(config)]); }
  };
  return std::visit(Visitor{config}, key.field);
}

bool is_allowed(const ConfigKey& key, double value) {
  return (value >= key.least && value <= key.most) || (key.may_be_zero && value == 0.0);
}

// Sets one key to what a text says; each answers false when that is not a value of the key's type
// and range.
struct ValueSetter {
  Config& config;
  const ConfigKey& key;
  std::string_view text;

  template <class Number>
  bool operator()(const Field<Number>& field) const {
    const auto value = parse_number<Number>(text);
    if (!value || !is_allowed(key, *value)) return false;
    field.edit(config) = *value;
    return true;
  }
  bool operator()(const Field<bool>& field) const {
    field.edit(config) = text == "true";
    return text == "true" || text == "false";
  }
  bool operator()(const Field<std::string>& field) const {
    // A line break or another control character is never meant.
    const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
    if (std::any_of(text.begin(), text.end(), is_control)) return false;
    if (key.most > 0.0 && static_cast<double>(text.size()) > key.most) return false;
    field.edit(config) = text;
    return true;
  }
  bool operator()(const WordField& field) const {
    const auto word = std::find(field.words.begin(), field.words.end(), text);
    if (word == field.words.end()) return false;
    field.set(config, static_cast<std::size_t>(word - field.words.begin()));
    return true;
  }
};

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
  Setter(Config& config, ExitCode code) : config_(config), code_(code) {}

  Result<void> set(const std::string& where, std::string_view name, std::string_view value) {
    const ConfigKey* key = find_key(name);
    if (key == nullptr) return failure(code_, where + unknown_key(name));
    if (!seen_.insert(key).second) {
      return failure(code_, where + "key '" + std::string(name) + "' is given twice");
    }
    if (!std::visit(ValueSetter{config_, *key, value}, key->field)) {
      return failure(code_, where + "key '" + std::string(name) + "': found '" +
                                std::string(value) + "', allowed is " + describe_range(*key) +
                                describe_limits(*key) + suggest_word(*key, value));
    }
    return {};
  }

 private:
  Config& config_;
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
    if (!entry.second.IsScalar() && !entry.second.IsNull()) {
      return failure(ExitCode::kConfiguration,
                     where + "key '" + name + "': found a list or a map, one value is needed");
    }
    const auto set = setter.set(where, name, entry.second.IsScalar() ? entry.second.Scalar() : "");
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

Result<Config> load_config(const std::string& path, const std::vector<ConfigSetting>& settings) {
  Config config;
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

std::string format_config(const Config& config) {
  std::string file =
      "# Configuration of Darkling: every key there is. One that is left out has its default.\n";
  for (const ConfigKey& key : config_keys()) {
    file += "\n# " + std::string(key.about) + "\n# Allowed: " + describe_range(key) + ".\n" +
            std::string(key.name) + ": " + value_text(config, key) + "\n";
  }
  return file;
}

}  // namespace darkling
