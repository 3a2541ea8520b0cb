// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <type_traits>

#include "base/check.h"
#include "base/image_view.h"

namespace darkling {

// The one block of memory a pipeline lives in: allocate at start, seal, and from then on a request
// is a bug and aborts. Nothing is ever given back before the arena itself goes.
// Thread: one thread until sealed; the memory handed out has its own rules.
class Arena {
 public:
  // An arena without memory: it keeps account of what it is asked for and hands out views of
  // nothing, in which nothing is constructed. What it has counted at the end, used_bytes(), is the
  // capacity of the arena that the same requests fill to the last byte.
  [[nodiscard]] static Arena measuring() { return {}; }
  // Reserves `capacity_bytes`, zeroed and touched, aligned to a cache line.
  explicit Arena(std::size_t capacity_bytes);
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // An array of `count` value-initialised elements, aligned to at least a cache line; empty when
  // the arena only measures. `name` (static storage) labels it in the memory map.
  template <class T>
  [[nodiscard]] std::span<T> allocate(std::size_t count, const char* name) {
    static_assert(std::is_trivially_destructible_v<T>, "the arena never runs destructors");
    CHECK(count <= std::numeric_limits<std::size_t>::max() / sizeof(T), "a size that wraps round");
    T* first = static_cast<T*>(allocate_bytes(count * sizeof(T), alignof(T), name));
    if (first == nullptr) return {};
    for (std::size_t i = 0; i < count; ++i) new (first + i) T();
    return {first, count};
  }

  // An image whose rows may be read up to 64 bytes past their end, and start on cache lines if the
  // size of a pixel divides one. When the arena only measures it has its size, but no pixels.
  template <class T>
  [[nodiscard]] ImageView<T> allocate_image(int width, int height, const char* name) {
    CHECK(width > 0 && height > 0, "an image has pixels");
    constexpr std::size_t kRowAlignment = (64 + sizeof(T) - 1) / sizeof(T);
    const std::size_t stride = (width + kRowAlignment - 1) / kRowAlignment * kRowAlignment;
    std::span<T> pixels = allocate<T>(stride * height + kRowAlignment, name);
    return {pixels.data(), width, height, static_cast<std::ptrdiff_t>(stride)};
  }

  void seal() { is_sealed_ = true; }
  [[nodiscard]] bool is_sealed() const { return is_sealed_; }
  [[nodiscard]] std::size_t used_bytes() const { return used_bytes_; }
  [[nodiscard]] std::size_t capacity_bytes() const { return capacity_bytes_; }

  struct Entry {
    const char* name;
    std::size_t bytes;
  };
  // What was handed out, in order: the memory map that a reviewer adds up.
  [[nodiscard]] std::span<const Entry> entries() const { return {entries_, entry_count_}; }

 private:
  Arena() = default;
  // @return null when the arena only measures.
  [[nodiscard]] void* allocate_bytes(std::size_t bytes, std::size_t alignment, const char* name);

  static constexpr std::size_t kMaxEntries = 256;
  std::byte* block_ = nullptr;  // null: measures
  std::size_t capacity_bytes_ = std::numeric_limits<std::size_t>::max();
  std::size_t used_bytes_ = 0;
  bool is_sealed_ = false;
  Entry entries_[kMaxEntries] = {};
  std::size_t entry_count_ = 0;
};

}  // namespace darkling
