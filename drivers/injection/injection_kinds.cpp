// SPDX-License-Identifier: Apache-2.0
#include "base/number_text.h"
#include "drivers/injection/injection.h"
#include "drivers/injection/light.h"
#include "drivers/sensor/mix64.h"

namespace darkling {

namespace {

using enum ValueForm;

constexpr InjectionKind kKinds[] = {
    {"electrons", kNumber, "N", 0.1, 100000, "light for N photo-electrons a pixel on average",
     make_electrons},
    {"gain", kNumber, "F", 0.01, 100, "brighter by the factor F, clipped", make_gain},
};

// FNV-1a.
std::uint64_t hash_of(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : name) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3ull;
  return hash;
}

std::string spelt(const InjectionKind& kind) {
  const std::string name(kind.name);
  return kind.form == kNone ? name : name + "=" + std::string(kind.value_name);
}

}  // namespace

std::span<const InjectionKind> injection_kinds() {
  return kKinds;
}

std::string describe_injections() {
  constexpr std::size_t kColumn = 22;
  std::string text;
  for (const InjectionKind& kind : kKinds) {
    std::string line = "  " + spelt(kind);
    line.resize(std::max(kColumn, line.size() + 2), ' ');
    line += kind.meaning;
    if (kind.form == kNumber || kind.form == kWholeNumber) {
      line += "; " + number_text(kind.lowest) + " to " + number_text(kind.highest);
    }
    text += line + "\n";
  }
  return text;
}

std::uint64_t noise_key(const Injection& injection, std::int64_t sequence, int stream) {
  const std::uint64_t seeded = mix64(injection.seed + hash_of(injection.kind->name));
  return mix64(mix64(seeded + static_cast<std::uint64_t>(sequence)) +
               static_cast<std::uint64_t>(stream));
}

}  // namespace darkling
