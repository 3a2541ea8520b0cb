// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace darkling {

// A queue of at most `N` elements between two threads, without locks or heap, for small elements
// that move cheaply (leases, indices).
//
// Newest wins: a consumer that must not fall behind calls pop_newest() and lets the older ones go.
// Only the consumer takes out, so a full ring refuses the newest. Give the ring at least as many
// places as there are leases to hand out: then it is never full.
// Thread: try_push() from one thread, try_pop() and pop_newest() from one other.
template <class T, std::size_t N>
class SpscRing {
  static_assert(N > 0);

 public:
  // @return whether there was room; if not, `value` is untouched and still the caller's.
  [[nodiscard]] bool try_push(T&& value) {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == N) return false;
    items_[place(end)] = std::move(value);
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  // The oldest element, or nothing.
  [[nodiscard]] std::optional<T> try_pop() {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return std::nullopt;
    // Leaves a default element behind: what a moved-from one may still own goes here and now.
    std::optional<T> value(std::exchange(items_[place(begin)], T()));
    begin_.store(begin + 1, std::memory_order_release);
    return value;
  }

  // The newest element, or nothing; the older ones are dropped and their number added to `skipped`.
  [[nodiscard]] std::optional<T> pop_newest(std::int64_t& skipped) {
    std::optional<T> newest = try_pop();
    while (newest) {
      std::optional<T> next = try_pop();
      if (!next) break;
      newest = std::move(next);
      ++skipped;
    }
    return newest;
  }

  [[nodiscard]] static constexpr std::size_t capacity() { return N; }

 private:
  // Where the element with this number lies; smaller than N, so it fits a 32-bit size_t too.
  static constexpr std::size_t place(std::uint64_t number) {
    return static_cast<std::size_t>(number % N);
  }

  // Counts since the start; 64 bits do not wrap. Each on its own cache line: the two threads write
  // one each.
  static constexpr std::size_t kCacheLine = 64;
  alignas(kCacheLine) std::atomic<std::uint64_t> begin_ = 0;
  alignas(kCacheLine) std::atomic<std::uint64_t> end_ = 0;
  alignas(kCacheLine) std::array<T, N> items_ = {};
};

}  // namespace darkling
