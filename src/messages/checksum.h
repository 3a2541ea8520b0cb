// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace darkling {

// FNV-1a over little-endian words of eight bytes, the last filled up with zeros, and then over the
// length. Any change of a single word changes it, as every step is one-to-one in the word.
// Words instead of bytes: the multiplications wait for each other, and eight times as many took
// 1 ms instead of 0.1 for a pair of 752x480 px.
[[nodiscard]] std::uint64_t checksum_of(std::span<const std::byte> bytes);

// Encoded records of a frame log begin with the fingerprint of their type and their checksum.
inline constexpr std::size_t kSealedFrom = 16;  // where what the checksum is of begins, bytes

// Writes the checksum into an encoded record. @pre it is at least kSealedFrom bytes.
void seal_record(std::span<std::byte> record);
// Whether the checksum in an encoded record is right.
[[nodiscard]] bool is_record_sound(std::span<const std::byte> record);

// The same for the head of an encoded frame_t: its fields from seq to size, which begin at byte 24.
inline constexpr std::size_t kFrameHeadEnd = 60;  // where the pixels begin, bytes
// @pre of both: at least kFrameHeadEnd bytes.
void seal_frame_head(std::span<std::byte> record);
[[nodiscard]] bool is_frame_head_sound(std::span<const std::byte> record);

}  // namespace darkling
