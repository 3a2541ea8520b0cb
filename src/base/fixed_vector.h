// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "base/check.h"

namespace darkling {

// A list of at most `N` elements that lives where it stands: no heap, the capacity in the type.
// Places not in use hold a default T; what an element owns goes when the element is taken out.
template <class T, std::size_t N>
class FixedVector {
 public:
  // @return whether there was room; if not, nothing has changed and `value` is still the caller's.
  [[nodiscard]] bool push_back(const T& value) {
    if (is_full()) return false;
    items_[size_++] = value;
    return true;
  }
  [[nodiscard]] bool push_back(T&& value) {
    if (is_full()) return false;
    items_[size_++] = std::move(value);
    return true;
  }

  void pop_back() {
    CHECK(size_ > 0, "an element is taken from an empty list");
    --size_;
    release(size_);
  }

  void clear() {
    while (size_ > 0) pop_back();
  }

  // Takes out the element at `index`; those behind it move up, in order.
  void erase(std::size_t index) {
    CHECK(index < size_, "index beyond the end of a list");
    for (std::size_t i = index; i + 1 < size_; ++i) items_[i] = std::move(items_[i + 1]);
    pop_back();
  }

  [[nodiscard]] T& operator[](std::size_t index) {
    CHECK(index < size_, "index beyond the end of a list");
    return items_[index];
  }
  [[nodiscard]] const T& operator[](std::size_t index) const {
    CHECK(index < size_, "index beyond the end of a list");
    return items_[index];
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] static constexpr std::size_t capacity() { return N; }
  [[nodiscard]] bool is_empty() const { return size_ == 0; }
  [[nodiscard]] bool is_full() const { return size_ == N; }

  [[nodiscard]] T* data() { return items_.data(); }
  [[nodiscard]] const T* data() const { return items_.data(); }
  [[nodiscard]] T* begin() { return items_.data(); }
  [[nodiscard]] T* end() { return items_.data() + size_; }
  [[nodiscard]] const T* begin() const { return items_.data(); }
  [[nodiscard]] const T* end() const { return items_.data() + size_; }

 private:
  void release(std::size_t index) {
    if constexpr (!std::is_trivially_destructible_v<T>) items_[index] = T();
  }

  std::array<T, N> items_ = {};
  std::size_t size_ = 0;
};

}  // namespace darkling
