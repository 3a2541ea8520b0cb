// SPDX-License-Identifier: Apache-2.0
#include "messages/wire.h"

#include <algorithm>
#include <cstdint>

#include "messages/big_endian.h"
#include "messages/checksum.h"
#include "messages/frame_t.hpp"
#include "messages/rig_t.hpp"
#include "messages/status_t.hpp"
#include "messages/truth_t.hpp"

namespace darkling {

namespace {

// Behind the fingerprint: checksum, frame, key.
constexpr std::size_t kTruthCountAt = 18;

// Whether the bytes from `at` on are exactly `count` strings: a length that counts the final zero,
// the characters, the zero.
bool are_strings(std::span<const std::byte> bytes, std::size_t at, int count) {
  for (int i = 0; i < count; ++i) {
    if (bytes.size() < at + sizeof(std::int32_t)) return false;
    const auto length = load_big_endian<std::int32_t>(bytes, at);
    at += sizeof(std::int32_t);
    if (length < 1 || bytes.size() - at < static_cast<std::size_t>(length)) return false;
    const auto text = bytes.subspan(at, static_cast<std::size_t>(length));
    // A zero within would end the string when it is sent on.
    if (std::find(text.begin(), text.end(), std::byte{0}) != text.end() - 1) return false;
    at += text.size();
  }
  return at == bytes.size();
}

// The same for a type whose members of variable length are three strings at its end.
template <class Message>
bool ends_in_three_strings(std::span<const std::byte> bytes) {
  constexpr int kCount = 3;
  constexpr int kEmptySize = 5;  // the length and the zero
  static const int kFirstAt = Message{}.getEncodedSize() - kCount * kEmptySize;
  return are_strings(bytes, static_cast<std::size_t>(kFirstAt), kCount);
}

}  // namespace

bool have_lengths_room(std::span<const std::byte> bytes, const frame_t& /*type*/) {
  if (bytes.size() < kFrameHeadEnd) return false;
  const auto size = load_big_endian<std::int32_t>(bytes, kFrameHeadEnd - sizeof(std::int32_t));
  return size >= 0 && (bytes.size() - kFrameHeadEnd) / 2 == static_cast<std::size_t>(size);
}

bool have_lengths_room(std::span<const std::byte> bytes, const rig_t& /*type*/) {
  return ends_in_three_strings<rig_t>(bytes);
}

bool have_lengths_room(std::span<const std::byte> bytes, const status_t& /*type*/) {
  return ends_in_three_strings<status_t>(bytes);
}

bool have_lengths_room(std::span<const std::byte> bytes, const truth_t& /*type*/) {
  constexpr std::size_t kFrom = kTruthCountAt + sizeof(std::int32_t);
  constexpr std::size_t kEach = 13 * 8;  // a key and twelve numbers
  if (bytes.size() < kFrom) return false;
  const auto count = load_big_endian<std::int32_t>(bytes, kTruthCountAt);
  return count >= 0 && (bytes.size() - kFrom) / kEach == static_cast<std::size_t>(count);
}

}  // namespace darkling
