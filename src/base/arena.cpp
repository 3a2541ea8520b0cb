// SPDX-License-Identifier: Apache-2.0
#include "base/arena.h"

#include <cstring>
#include <new>

namespace darkling {

namespace {
constexpr std::size_t kCacheLine = 64;
}

Arena::Arena(std::size_t capacity_bytes)
    : block_(static_cast<std::byte*>(
          ::operator new (capacity_bytes, std::align_val_t{kCacheLine}, std::nothrow))),
      capacity_bytes_(capacity_bytes) {
  CHECK(block_ != nullptr, "the machine has no memory for the arena");
  std::memset(block_, 0, capacity_bytes);  // touches every page, so that none is faulted in later
}

Arena::~Arena() {
  ::operator delete (block_, std::align_val_t{kCacheLine});
}

void* Arena::allocate_bytes(std::size_t bytes, std::size_t alignment, const char* name) {
  CHECK(!is_sealed_, "a sealed arena was asked for memory");
  CHECK(alignment <= kCacheLine, "the arena aligns to a cache line");
  CHECK(entry_count_ < kMaxEntries, "more buffers than the memory map has rows");
  const std::size_t start = (used_bytes_ + kCacheLine - 1) / kCacheLine * kCacheLine;
  CHECK(start <= capacity_bytes_ && bytes <= capacity_bytes_ - start, "the arena is full");
  entries_[entry_count_++] = {name, bytes};
  used_bytes_ = start + bytes;
  return block_ == nullptr ? nullptr : block_ + start;
}

}  // namespace darkling
