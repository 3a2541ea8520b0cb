// SPDX-License-Identifier: Apache-2.0
// Injections that show what was seen before.
#include <algorithm>

#include "drivers/injection/stored_image.h"
#include "drivers/injection/transport.h"

namespace darkling {

namespace {

// The pair before the range again and again, under new sequences and stamps; the first of the range
// where there is none before.
class Freeze final : public Injector {
 public:
  void start(ImageSize size) override {
    left_.claim(size);
    right_.claim(size);
    has_pair_ = false;
  }

  void pass(const InjectedPair& pair) override {
    left_.store(pair.left);
    right_.store(pair.right);
    has_pair_ = true;
  }

  FrameFault inject(InjectedPair& pair) override {
    if (!has_pair_) pass(pair);
    copy_pixels(left_.view(), pair.left);
    copy_pixels(right_.view(), pair.right);
    return FrameFault::kNone;
  }

 private:
  StoredImage left_;
  StoredImage right_;
  bool has_pair_ = false;
};

// The lower half is still that of the pair before, where there is one.
class Tear final : public Injector {
 public:
  explicit Tear(const Injection& injection)
      : is_left_(injection.value != 1.0), is_right_(injection.value != 0.0) {}  // left|right|both

  void start(ImageSize size) override {
    left_.claim(size);
    right_.claim(size);
    has_pair_ = false;
  }

  void pass(const InjectedPair& pair) override {
    left_.store(pair.left);
    right_.store(pair.right);
    has_pair_ = true;
  }

  FrameFault inject(InjectedPair& pair) override {
    if (!has_pair_) {
      pass(pair);
      return FrameFault::kNone;
    }
    exchange_lower_half(is_left_, pair.left, left_.view());
    exchange_lower_half(is_right_, pair.right, right_.view());
    return FrameFault::kNone;
  }

 private:
  // Only the lower half of what is stored is ever shown, so that the upper may stay.
  static void exchange_lower_half(bool is_torn, const ImageView<std::uint8_t>& image,
                                  const ImageView<std::uint8_t>& stored) {
    if (!is_torn) return;
    for (int y = image.height / 2; y < image.height; ++y) {
      std::swap_ranges(image.row(y), image.row(y) + image.width, stored.row(y));
    }
  }

  bool is_left_;
  bool is_right_;
  StoredImage left_;
  StoredImage right_;
  bool has_pair_ = false;
};

}  // namespace

std::unique_ptr<Injector> make_freeze(const Injection& /*injection*/) {
  return std::make_unique<Freeze>();
}

std::unique_ptr<Injector> make_tear(const Injection& injection) {
  return std::make_unique<Tear>(injection);
}

}  // namespace darkling
