// SPDX-License-Identifier: Apache-2.0
// Injections that show what was seen before.
#include <algorithm>

#include "drivers/injection/stored_image.h"
#include "drivers/injection/transport.h"

namespace darkling {

namespace {

struct PairBefore {
  void claim(ImageSize size) {
    left.claim(size);
    right.claim(size);
    is_there = false;
  }
  void store(const InjectedPair& pair) {
    left.store(pair.left);
    right.store(pair.right);
    is_there = true;
  }

  StoredImage left;
  StoredImage right;
  bool is_there = false;
};

// The pair before the range again and again, under new sequences and stamps; the first of the range
// where there is none before.
class Freeze final : public Injector {
 public:
  void start(ImageSize size) override { before_.claim(size); }
  void pass(const InjectedPair& pair) override { before_.store(pair); }

  FrameFault inject(InjectedPair& pair) override {
    if (!before_.is_there) pass(pair);
    copy_pixels(before_.left.view(), pair.left);
    copy_pixels(before_.right.view(), pair.right);
    return FrameFault::kNone;
  }

 private:
  PairBefore before_;
};

// The lower half is still that of the pair before, where there is one.
class Tear final : public Injector {
 public:
  explicit Tear(const Injection& injection)
      : is_left_(injection.value != 1.0), is_right_(injection.value != 0.0) {}  // left|right|both

  void start(ImageSize size) override { before_.claim(size); }
  void pass(const InjectedPair& pair) override { before_.store(pair); }

  FrameFault inject(InjectedPair& pair) override {
    if (!before_.is_there) {
      pass(pair);
      return FrameFault::kNone;
    }
    exchange_lower_half(is_left_, pair.left, before_.left.view());
    exchange_lower_half(is_right_, pair.right, before_.right.view());
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
  PairBefore before_;
};

}  // namespace

std::unique_ptr<Injector> make_freeze(const Injection& /*injection*/) {
  return std::make_unique<Freeze>();
}

std::unique_ptr<Injector> make_tear(const Injection& injection) {
  return std::make_unique<Tear>(injection);
}

}  // namespace darkling
