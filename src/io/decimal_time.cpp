// SPDX-License-Identifier: Apache-2.0
#include "io/decimal_time.h"

#include <charconv>
#include <cstdlib>

namespace darkling {

namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr int kDecimals = 9;
constexpr int kMaxExponent = 30;  // beyond it nothing fits, and digit strings would grow

template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Integer value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return value;
}

bool is_digits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::optional<std::int64_t> ns_from_seconds_text(std::string_view seconds) {
  const bool is_negative = !seconds.empty() && seconds.front() == '-';
  if (is_negative || (!seconds.empty() && seconds.front() == '+')) seconds.remove_prefix(1);

  int exponent = 0;
  if (const auto e = seconds.find_first_of("eE"); e != std::string_view::npos) {
    const auto parsed = parse_integer<int>(seconds.substr(e + 1));
    if (!parsed || std::abs(*parsed) > kMaxExponent) return std::nullopt;
    exponent = *parsed;
    seconds = seconds.substr(0, e);
  }
  const auto point = seconds.find('.');
  const std::string_view whole = seconds.substr(0, point);
  const std::string_view fraction =
      point == std::string_view::npos ? std::string_view() : seconds.substr(point + 1);
  if (whole.empty() && fraction.empty()) return std::nullopt;
  if (!is_digits(whole) || !is_digits(fraction)) return std::nullopt;

  // The digits of the nanoseconds, and what is cut off behind them.
  std::string digits = std::string(whole).append(fraction);
  const auto kept = static_cast<std::ptrdiff_t>(whole.size()) + exponent + kDecimals;
  if (kept < 0) return 0;
  const bool rounds_up = static_cast<std::size_t>(kept) < digits.size() && digits[kept] >= '5';
  digits.resize(kept, '0');
  const auto magnitude = parse_integer<std::int64_t>(digits.empty() ? "0" : digits);
  if (!magnitude || *magnitude == INT64_MAX) return std::nullopt;
  const std::int64_t ns = *magnitude + (rounds_up ? 1 : 0);
  return is_negative ? -ns : ns;
}

std::string seconds_text_from_ns(std::int64_t ns) {
  const bool is_negative = ns < 0;
  const std::uint64_t magnitude =
      is_negative ? 0 - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  std::string fraction = std::to_string(magnitude % kNsPerSecond);
  fraction.insert(0, kDecimals - fraction.size(), '0');
  return (is_negative ? "-" : "") + std::to_string(magnitude / kNsPerSecond) + "." + fraction;
}

}  // namespace darkling
