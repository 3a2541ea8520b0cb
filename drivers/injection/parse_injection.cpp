// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include "base/nearest.h"
#include "base/number_text.h"
#include "base/text_file.h"
#include "drivers/injection/injection.h"

namespace darkling {

namespace {

constexpr std::uint64_t kHighestSeed = std::uint64_t{1} << 53;  // as of the scenes

constexpr const char* kGrammar = "NAME[=VALUE][@FIRST:LAST][,seed=N]";

// A text cut in two at the first `mark`; without one there is no second part.
struct Halves {
  std::string_view first;
  std::optional<std::string_view> second;
};

Halves cut(std::string_view text, char mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return {.first = text, .second = std::nullopt};
  return {.first = text.substr(0, at), .second = text.substr(at + 1)};
}

std::string quoted(std::string_view text) {
  return "'" + std::string(text) + "'";
}

// What is wrong, after the text it is wrong in.
tl::unexpected<Error> refuse(std::string_view text, const std::string& what) {
  return failure(ExitCode::kUsage, "injection " + quoted(text) + ": " + what);
}

std::optional<double> number_in(const InjectionKind& kind, std::string_view word) {
  const auto number = parse_number<double>(word);
  if (!number || !(*number >= kind.lowest && *number <= kind.highest)) return std::nullopt;
  if (kind.form == ValueForm::kWholeNumber && *number != std::floor(*number)) return std::nullopt;
  return number;
}

std::optional<double> position_in(const InjectionKind& kind, std::string_view word) {
  const std::vector<std::string_view> words = split(kind.value_name, '|');
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == word) return static_cast<double>(i);
  }
  return std::nullopt;
}

Result<void> set_value(std::string_view text, std::optional<std::string_view> word,
                       Injection& injection) {
  const InjectionKind& kind = *injection.kind;
  const std::string name(kind.name);
  if (kind.form == ValueForm::kNone) {
    if (!word) return {};
    return refuse(text, name + " takes no value, found " + quoted(*word));
  }
  const std::string allowed =
      "allowed is " + name + "=" + std::string(kind.value_name) + " with " + allowed_values(kind);
  if (!word) return refuse(text, "the value is missing; " + allowed);
  const auto value =
      kind.form == ValueForm::kWord ? position_in(kind, *word) : number_in(kind, *word);
  if (!value) return refuse(text, "found " + quoted(*word) + ", " + allowed);
  injection.value = *value;
  return {};
}

Result<void> set_range(std::string_view text, std::string_view range, Injection& injection) {
  const Halves ends = cut(range, ':');
  const auto end_or = [](std::string_view word, std::int64_t otherwise) {
    return word.empty() ? otherwise : parse_number<std::int64_t>(word);
  };
  const auto first = end_or(ends.first, injection.first);
  const auto last = ends.second ? end_or(*ends.second, injection.last) : std::nullopt;
  if (!first || !last || *first < 0 || *last <= *first) {
    return refuse(text, "frames " + quoted(range) +
                            "; allowed is FIRST:LAST, the frames from FIRST up to but without "
                            "LAST, counted from 0, as 0:100, 50: or :200");
  }
  injection.first = *first;
  injection.last = *last;
  return {};
}

Result<void> set_seed(std::string_view text, std::string_view setting, Injection& injection) {
  constexpr std::string_view kKeys[] = {"seed"};
  const Halves halves = cut(setting, '=');
  if (halves.first != kKeys[0]) {
    return refuse(text, "unknown key " + quoted(halves.first) + did_you_mean(halves.first, kKeys) +
                            "; allowed is " + kGrammar);
  }
  const auto seed = parse_number<std::uint64_t>(halves.second.value_or(""));
  if (!seed || *seed > kHighestSeed) {
    return refuse(text, "seed: found " + quoted(halves.second.value_or("")) +
                            ", allowed is a whole number from 0 to " +
                            std::to_string(kHighestSeed));
  }
  injection.seed = *seed;
  return {};
}

const InjectionKind* find_kind(std::string_view name) {
  for (const InjectionKind& kind : injection_kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

std::string suggest(std::string_view name) {
  std::vector<std::string_view> names;
  for (const InjectionKind& kind : injection_kinds()) names.push_back(kind.name);
  return did_you_mean(name, names);
}

}  // namespace

std::string allowed_values(const InjectionKind& kind) {
  if (kind.form == ValueForm::kNone) return "no value";
  if (kind.form == ValueForm::kWord) return "one of " + join_names(split(kind.value_name, '|'));
  const std::string what = kind.form == ValueForm::kWholeNumber ? "a whole number" : "a number";
  return what + " from " + number_text(kind.lowest) + " to " + number_text(kind.highest);
}

Result<Injection> parse_injection(std::string_view text) {
  const Halves settings = cut(text, ',');
  const Halves frames = cut(settings.first, '@');
  const Halves value = cut(frames.first, '=');
  Injection injection;
  injection.text = text;
  injection.kind = find_kind(value.first);
  if (injection.kind == nullptr) {
    return refuse(text, "unknown name " + quoted(value.first) + suggest(value.first));
  }
  if (auto set = set_value(text, value.second, injection); !set) {
    return tl::unexpected(set.error());
  }
  if (frames.second) {
    if (auto set = set_range(text, *frames.second, injection); !set) {
      return tl::unexpected(set.error());
    }
  }
  if (settings.second) {
    if (auto set = set_seed(text, *settings.second, injection); !set) {
      return tl::unexpected(set.error());
    }
  }
  return injection;
}

Result<std::vector<Injection>> parse_injections(std::span<const std::string> texts) {
  std::vector<Injection> injections;
  for (const std::string& text : texts) {
    auto injection = parse_injection(text);
    if (!injection) return tl::unexpected(injection.error());
    injections.push_back(std::move(*injection));
  }
  return injections;
}

}  // namespace darkling
