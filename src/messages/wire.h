// SPDX-License-Identifier: Apache-2.0
// Messages to bytes and back, for any of the generated types.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace darkling {

class frame_t;
class rig_t;
class status_t;
class truth_t;

// Generated code reads and writes doubles as integers, which lets a compiler move what it knows of
// the doubles past it: with gcc 12 at -O3 a message went out with the zeros it was made with. Here
// all of `object` is in memory, and may have changed.
template <class Object>
void settle_memory(Object& object) {
  asm volatile("" : : "r"(&object) : "memory");
}

// Writes `message` to the front of `buffer`, without a call of the heap: with a buffer that lives
// on, and the raw publish of LCM, so is sending it.
// @return how many bytes were written; 0: the buffer is too small.
template <class Message>
[[nodiscard]] std::size_t encode_into(std::span<std::byte> buffer, const Message& message) {
  if (message.getEncodedSize() < 0 ||
      buffer.size() < static_cast<std::size_t>(message.getEncodedSize())) {
    return 0;
  }
  settle_memory(message);
  const int written = message.encode(buffer.data(), 0, message.getEncodedSize());
  return written > 0 ? static_cast<std::size_t>(written) : 0;
}

// Whether the arrays and strings of an encoded message are as long as its bytes can hold. Generated
// decoders do not ask in time: one flipped bit in the length of an array claims 2 GiB, a string of
// -2^31 reads as much beyond the message, one of 0 throws.
template <class Message>
[[nodiscard]] bool have_lengths_room(std::span<const std::byte> /*bytes*/, const Message&) {
  return true;  // of one length, always
}
[[nodiscard]] bool have_lengths_room(std::span<const std::byte> bytes, const frame_t&);
[[nodiscard]] bool have_lengths_room(std::span<const std::byte> bytes, const rig_t&);
[[nodiscard]] bool have_lengths_room(std::span<const std::byte> bytes, const status_t&);
[[nodiscard]] bool have_lengths_room(std::span<const std::byte> bytes, const truth_t&);

// Reads a message that may be anything at all. Memory that `message` has is used again.
// @return whether `bytes` are one message of this type, whole and with nothing behind it; if not,
//         `message` may hold any values.
template <class Message>
[[nodiscard]] bool decode_from(std::span<const std::byte> bytes, Message& message) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return false;
  if (!have_lengths_room(bytes, message)) return false;
  const int size = static_cast<int>(bytes.size());
  settle_memory(message);
  const bool is_whole = message.decode(bytes.data(), 0, size) == size;
  settle_memory(message);
  return is_whole;
}

}  // namespace darkling
