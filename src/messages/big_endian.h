// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace darkling {

// Integers as LCM writes them, in messages and in log files: most significant byte first.
// @pre of both: `bytes` hold the integer at `offset`.
template <class Integer>
[[nodiscard]] Integer load_big_endian(std::span<const std::byte> bytes, std::size_t offset) {
  std::make_unsigned_t<Integer> value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    value = static_cast<decltype(value)>(value << 8 | std::to_integer<unsigned>(bytes[offset + i]));
  }
  return std::bit_cast<Integer>(value);
}

template <class Integer>
void store_big_endian(Integer value, std::span<std::byte> bytes, std::size_t offset) {
  const auto bits = std::bit_cast<std::make_unsigned_t<Integer>>(value);
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    bytes[offset + i] = static_cast<std::byte>(bits >> 8 * (sizeof(Integer) - 1 - i));
  }
}

}  // namespace darkling
