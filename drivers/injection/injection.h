// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "drivers/injection/injector.h"

namespace darkling {

struct Injection;

enum class ValueForm { kNone = 0, kNumber, kWholeNumber, kWord };

// One kind of thing that can go wrong; all that its name, its value and the help need to know.
struct InjectionKind {
  std::string_view name;
  ValueForm form = ValueForm::kNone;
  std::string_view value_name;  // as the help shows it; of kWord, the words: "left|right"
  double lowest = 0.0;          // of a number
  double highest = 0.0;
  std::string_view meaning;  // half a line
  std::unique_ptr<Injector> (*make)(const Injection& injection) = nullptr;
};

// What is to go wrong, how much, and when.
struct Injection {
  const InjectionKind* kind = nullptr;
  double value = 0.0;      // of kWord, the position among the words
  std::int64_t first = 0;  // by sequence: [first, last)
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::uint64_t seed = 1;
  std::string text;  // as it was given

  [[nodiscard]] bool is_due(std::int64_t sequence) const {
    return sequence >= first && sequence < last;
  }
};

// All kinds, in the order of the help.
[[nodiscard]] std::span<const InjectionKind> injection_kinds();

// @param text  NAME[=VALUE][@FIRST:LAST][,seed=N]: frames from FIRST up to but without LAST, by
//              their sequence, either of which may be left out.
// @return kUsage with what was found and what is allowed.
[[nodiscard]] Result<Injection> parse_injection(std::string_view text);
[[nodiscard]] Result<std::vector<Injection>> parse_injections(std::span<const std::string> texts);

// "a number from 0.1 to 100000".
[[nodiscard]] std::string allowed_values(const InjectionKind& kind);
// A line a kind, indented, for the help of a command.
[[nodiscard]] std::string describe_injections();

// Of the noise of an injection, one for each purpose.
inline constexpr int kLeftEye = 0;
inline constexpr int kRightEye = 1;
inline constexpr int kBothEyes = 2;  // what happens to both
inline constexpr int kPath = 3;      // where

// Chooses the noise: another for every kind, seed, sequence and stream.
[[nodiscard]] std::uint64_t noise_key(const Injection& injection, std::int64_t sequence,
                                      int stream);

}  // namespace darkling
