// SPDX-License-Identifier: Apache-2.0
#include "messages/checksum.h"

#include <algorithm>

#include "base/check.h"
#include "messages/big_endian.h"

namespace darkling {

namespace {

constexpr std::size_t kWordSize = 8;
constexpr std::size_t kChecksumAt = 8;  // behind the fingerprint
constexpr std::size_t kFrameHeadChecksumAt = 16;
constexpr std::size_t kFrameHeadFrom = 24;

// Byte by byte, so that every machine reads the same word; compilers make one load of it.
std::uint64_t load_word(std::span<const std::byte> bytes) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    word |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
  }
  return word;
}

std::span<const std::byte> frame_head(std::span<const std::byte> record) {
  CHECK(record.size() >= kFrameHeadEnd, "the record holds the head of a frame");
  return record.subspan(kFrameHeadFrom, kFrameHeadEnd - kFrameHeadFrom);
}

}  // namespace

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  constexpr std::uint64_t kBasis = 0xcbf29ce484222325;
  constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t hash = kBasis;
  std::size_t at = 0;
  for (; at + kWordSize <= bytes.size(); at += kWordSize) {
    hash = (hash ^ load_word(bytes.subspan(at).first<kWordSize>())) * kPrime;
  }
  hash = (hash ^ load_word(bytes.subspan(at))) * kPrime;
  return (hash ^ bytes.size()) * kPrime;
}

void seal_record(std::span<std::byte> record) {
  CHECK(record.size() >= kSealedFrom, "the record holds a checksum");
  store_big_endian(checksum_of(record.subspan(kSealedFrom)), record, kChecksumAt);
}

bool is_record_sound(std::span<const std::byte> record) {
  return record.size() >= kSealedFrom && load_big_endian<std::uint64_t>(record, kChecksumAt) ==
                                             checksum_of(record.subspan(kSealedFrom));
}

void seal_frame_head(std::span<std::byte> record) {
  store_big_endian(checksum_of(frame_head(record)), record, kFrameHeadChecksumAt);
}

bool is_frame_head_sound(std::span<const std::byte> record) {
  return load_big_endian<std::uint64_t>(record, kFrameHeadChecksumAt) ==
         checksum_of(frame_head(record));
}

}  // namespace darkling
