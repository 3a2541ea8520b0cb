// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/synthetic_spec.h"

#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <variant>
#include <vector>

#include "base/nearest.h"

namespace darkling {

namespace {

constexpr std::string_view kPrefix = "synthetic:";
constexpr std::array<std::string_view, 3> kScenes = {"mine", "quarry", "corridor"};

using Member = std::variant<int SyntheticSpec::*, std::uint64_t SyntheticSpec::*,
                            double SyntheticSpec::*, bool SyntheticSpec::*>;

struct Key {
  std::string_view name;
  Member member;
  double lowest;
  double highest;
};

// Seeds are kept to what a double holds exactly, so that one table serves all types.
constexpr std::array<Key, 14> kKeys = {{
    {"frames", &SyntheticSpec::frames, 1, 5000},
    {"seed", &SyntheticSpec::seed, 0, 9007199254740992.0},
    {"width", &SyntheticSpec::width, 64, 1920},
    {"height", &SyntheticSpec::height, 48, 1440},
    {"rate_hz", &SyntheticSpec::rate_hz, 1, 200},
    {"speed", &SyntheticSpec::speed, 0, 2},
    {"exposure_ms", &SyntheticSpec::exposure_ms, 0.01, 100},
    {"gain", &SyntheticSpec::gain, 0.01, 100},
    {"electrons", &SyntheticSpec::electrons, 0.1, 100000},
    {"read_noise_e", &SyntheticSpec::read_noise_e, 0, 1000},
    {"vignetting", &SyntheticSpec::vignetting, 0, 1},
    {"distortion", &SyntheticSpec::distortion, 0, 1},
    {"roll_right_deg", &SyntheticSpec::roll_right_deg, -5, 5},
    {"blur", &SyntheticSpec::blur, 0, 1},
}};

std::vector<std::string_view> key_names() {
  std::vector<std::string_view> names;
  names.reserve(kKeys.size());
  for (const Key& key : kKeys) names.push_back(key.name);
  return names;
}

std::string allowed_range(const Key& key) {
  std::ostringstream out;
  out.precision(17);
  const bool is_whole = !std::holds_alternative<double SyntheticSpec::*>(key.member);
  out << (is_whole ? "a whole number from " : "a number from ") << key.lowest << " to "
      << key.highest;
  return out.str();
}

const Key* find_key(std::string_view name) {
  for (const Key& key : kKeys) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

double get(const SyntheticSpec& spec, const Key& key) {
  return std::visit([&](auto member) { return static_cast<double>(spec.*member); }, key.member);
}

Result<void> check_range(const Key& key, double value, std::string_view found) {
  if (value >= key.lowest && value <= key.highest) return {};
  return failure(ExitCode::kUsage, "synthetic: " + std::string(key.name) + "=" +
                                       std::string(found) +
                                       " is out of range; allowed: " + allowed_range(key));
}

}  // namespace

Result<void> set_synthetic_key(SyntheticSpec& spec, std::string_view name, std::string_view value) {
  const Key* key = find_key(name);
  if (key == nullptr) {
    return failure(ExitCode::kUsage, "synthetic: unknown key \"" + std::string(name) + "\"" +
                                         did_you_mean(name, key_names()));
  }
  double number = 0.0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool is_whole = !std::holds_alternative<double SyntheticSpec::*>(key->member);
  const bool is_number = error == std::errc() && end == value.data() + value.size() &&
                         std::isfinite(number) && !(is_whole && number != std::floor(number));
  if (!is_number) {
    return failure(ExitCode::kUsage, "synthetic: " + std::string(name) + "=\"" +
                                         std::string(value) + "\" is not " + allowed_range(*key));
  }
  if (auto in_range = check_range(*key, number, value); !in_range) return in_range;
  std::visit(
      [&](auto member) {
        using T = std::decay_t<decltype(spec.*member)>;
        spec.*member = static_cast<T>(number);
      },
      key->member);
  return {};
}

Result<void> check_synthetic(SyntheticSpec& spec) {
  bool is_known = false;
  for (std::string_view scene : kScenes) is_known = is_known || scene == spec.scene;
  if (!is_known) {
    return failure(ExitCode::kUsage, "synthetic: unknown scene \"" + spec.scene + "\"" +
                                         did_you_mean(spec.scene, kScenes));
  }
  if (spec.height == 0) spec.height = (spec.width * 3 + 2) / 4;
  for (const Key& key : kKeys) {
    const double value = get(spec, key);
    std::ostringstream found;
    found << value;
    if (auto in_range = check_range(key, value, found.str()); !in_range) return in_range;
  }
  if (spec.height * 4 < spec.width || spec.height * 2 > spec.width * 3) {
    return failure(ExitCode::kUsage, "synthetic: height=" + std::to_string(spec.height) +
                                         " does not go with width=" + std::to_string(spec.width) +
                                         "; allowed: a quarter to one and a half times the width");
  }
  return {};
}

Result<SyntheticSpec> parse_synthetic(std::string_view text) {
  if (!text.starts_with(kPrefix)) {
    return failure(ExitCode::kUsage, "\"" + std::string(text) +
                                         "\" is not a synthetic source; allowed: "
                                         "synthetic:SCENE[,key=value...] with SCENE one of " +
                                         join_names(kScenes));
  }
  text.remove_prefix(kPrefix.size());
  SyntheticSpec spec;
  std::size_t comma = text.find(',');
  spec.scene = text.substr(0, comma);
  while (comma != std::string_view::npos) {
    text.remove_prefix(comma + 1);
    comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos) {
      return failure(ExitCode::kUsage,
                     "synthetic: \"" + std::string(item) +
                         "\" is not key=value; known keys: " + join_names(key_names()));
    }
    const auto set = set_synthetic_key(spec, item.substr(0, equals), item.substr(equals + 1));
    if (!set) return tl::unexpected<Error>(set.error());
  }
  if (auto checked = check_synthetic(spec); !checked) {
    return tl::unexpected<Error>(checked.error());
  }
  return spec;
}

}  // namespace darkling
