// SPDX-License-Identifier: Apache-2.0
#include "vo/memory_map.h"

#include <algorithm>

#include "vo/odometry.h"

namespace darkling {

std::size_t find_buffer_row(std::string_view name) {
  const auto row = std::find_if(kBufferRows.begin(), kBufferRows.end(),
                                [name](const BufferRow& one) { return one.name == name; });
  return static_cast<std::size_t>(row - kBufferRows.begin());
}

MemoryMap map_memory(const OdometryConfig& config, int width_px, int height_px) {
  Arena arena = Arena::measuring();
  Odometry::claim_buffers(config, width_px, height_px, arena);
  MemoryMap map;
  map.arena_bytes = arena.used_bytes();
  map.gap_bytes = map.arena_bytes;
  map.state_bytes = Odometry::state_bytes();
  for (const Arena::Entry& entry : arena.entries()) {
    const std::size_t row = find_buffer_row(entry.name);
    CHECK(row < kBufferRows.size(), "every buffer has its row in vo/memory_map.h");
    map.bytes[row] += entry.bytes;
    ++map.counts[row];
    map.gap_bytes -= entry.bytes;
  }
  return map;
}

}  // namespace darkling
