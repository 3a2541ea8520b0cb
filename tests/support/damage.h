// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

namespace darkling::test {

// A few bytes changed, a piece removed, doubled or moved, or the end cut off.
// @pre there are some.
inline void damage(std::vector<std::byte>& bytes, std::mt19937& random) {
  const std::size_t at = random() % bytes.size();
  const std::size_t length = 1 + random() % std::min<std::size_t>(bytes.size() - at, 64);
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto last = first + static_cast<std::ptrdiff_t>(length);
  const std::vector<std::byte> piece(first, last);
  const auto elsewhere = [&] {
    return bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size());
  };
  switch (random() % 5) {
    case 0:
      for (auto byte = first; byte != last; ++byte) *byte = static_cast<std::byte>(random());
      break;
    case 1:
      *first ^= std::byte{1} << random() % 8;
      break;
    case 2:
      if (bytes.size() > length) bytes.erase(first, last);
      break;
    case 3:
      bytes.insert(elsewhere(), piece.begin(), piece.end());
      break;
    default:
      if (random() % 8 == 0) bytes.resize(at + 1);
  }
}

}  // namespace darkling::test
