// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>

#include "base/check.h"

namespace darkling {

// A rectangle of pixels that somebody else owns. Row-major; `stride` counts elements (not bytes)
// from one row to the next and may exceed `width`. The centre of the top-left pixel is (0, 0).
template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0;   // px
  int height = 0;  // px
  std::ptrdiff_t stride = 0;

  ImageView() = default;
  ImageView(T* data_, int width_, int height_, std::ptrdiff_t stride_)
      : data(data_), width(width_), height(height_), stride(stride_) {}

  // A view of mutable pixels reads as a view of constant ones.
  template <class U>
  requires(std::is_same_v<T, const U>)
      ImageView(const ImageView<U>& other)  // NOLINT(google-explicit-constructor)
      : data(other.data), width(other.width), height(other.height), stride(other.stride) {}

  [[nodiscard]] T* row(int y) const { return data + y * stride; }
  [[nodiscard]] T& at(int x, int y) const { return row(y)[x]; }
  [[nodiscard]] bool is_empty() const { return data == nullptr || width <= 0 || height <= 0; }
  [[nodiscard]] bool has_size(int w, int h) const { return width == w && height == h; }
};

template <class A, class B>
[[nodiscard]] bool have_same_size(const ImageView<A>& a, const ImageView<B>& b) {
  return a.width == b.width && a.height == b.height;
}

}  // namespace darkling
