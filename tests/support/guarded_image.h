// SPDX-License-Identifier: Apache-2.0
// Images that notice what a kernel does outside its rows: padding with a known pattern on every
// side, and a page that must not be touched right beside the image.
#pragma once

#include <cstddef>
#include <span>

#include <gtest/gtest.h>

#include "base/image_view.h"

namespace darkling::test {

enum class GuardSide {
  kBehindLastRow,   // the last pixel ends where the forbidden page begins
  kBeforeFirstRow,  // the first pixel begins where the forbidden page ends
};

struct GuardedLayout {
  int width = 0;
  int height = 0;
  int row_padding = 0;        // elements between the end of a row and the start of the next
  int distance_to_guard = 0;  // elements of padding between the image and the forbidden page
  GuardSide guard = GuardSide::kBehindLastRow;
};

// The bytes below a GuardedImage: readable pages full of a pattern, with a forbidden page on both
// ends.
class GuardedMemory {
 public:
  explicit GuardedMemory(std::size_t min_bytes);
  ~GuardedMemory();
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;

  [[nodiscard]] std::span<std::byte> bytes() const { return bytes_; }
  // What byte `index` held before anybody wrote; no two neighbours are equal.
  [[nodiscard]] static std::byte pattern(std::size_t index);

 private:
  std::span<std::byte> bytes_;  // without the forbidden pages
};

// An image of `T` in guarded memory. Its pixels hold the pattern until somebody writes them.
template <class T>
class GuardedImage {
 public:
  explicit GuardedImage(const GuardedLayout& layout)
      : layout_(layout), memory_((image_elements() + 2 * margin_elements()) * sizeof(T)) {
    const auto capacity = static_cast<std::ptrdiff_t>(memory_.bytes().size() / sizeof(T));
    const std::ptrdiff_t first = layout.guard == GuardSide::kBehindLastRow
                                     ? capacity - layout.distance_to_guard - image_elements()
                                     : layout.distance_to_guard;
    void* page = memory_.bytes().data();  // aligned for every T
    T* elements = static_cast<T*>(page);
    view_ = {elements + first, layout.width, layout.height, stride()};
  }

  [[nodiscard]] ImageView<T> view() { return view_; }
  [[nodiscard]] ImageView<const T> view() const { return view_; }

  // Whether every byte outside the rows still holds the pattern; says which one does not.
  [[nodiscard]] ::testing::AssertionResult padding_is_untouched() const {
    const std::span<const std::byte> bytes = memory_.bytes();
    const auto origin = reinterpret_cast<const std::byte*>(view_.data) - bytes.data();
    const auto stride_bytes = stride() * static_cast<std::ptrdiff_t>(sizeof(T));
    const auto width_bytes = layout_.width * static_cast<std::ptrdiff_t>(sizeof(T));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::ptrdiff_t from_origin = static_cast<std::ptrdiff_t>(i) - origin;
      const bool is_pixel = from_origin >= 0 && from_origin / stride_bytes < layout_.height &&
                            from_origin % stride_bytes < width_bytes;
      if (!is_pixel && bytes[i] != GuardedMemory::pattern(i)) {
        return ::testing::AssertionFailure()
               << "byte " << from_origin << " from the first pixel was overwritten (row of "
               << width_bytes << " bytes, stride " << stride_bytes << ", height " << layout_.height
               << ")";
      }
    }
    return ::testing::AssertionSuccess();
  }

 private:
  [[nodiscard]] std::ptrdiff_t stride() const { return layout_.width + layout_.row_padding; }
  [[nodiscard]] std::ptrdiff_t image_elements() const {
    return stride() * (layout_.height - 1) + layout_.width;
  }
  // Room for the pattern on the side without the guard: wider than any vector.
  [[nodiscard]] std::ptrdiff_t margin_elements() const { return layout_.distance_to_guard + 128; }

  GuardedLayout layout_;
  GuardedMemory memory_;
  ImageView<T> view_;
};

}  // namespace darkling::test
