// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdint>

#include "drivers/injection/stored_image.h"
#include "drivers/injection/transport.h"

namespace darkling {

namespace {

// The right image is `value` ms older than the left: the one taken then, or what lies between the
// two taken around then, mixed in proportion. A mix shows edges twice rather than half way. The
// oldest there is where none is old enough.
class Skew final : public Injector {
 public:
  explicit Skew(const Injection& injection)
      : age_(static_cast<std::int64_t>(std::llround(injection.value * 1e6))) {}

  void start(ImageSize size) override {
    for (Taken& taken : history_) taken.image.claim(size);
    count_ = 0;
  }

  void pass(const InjectedPair& pair) override {
    ++count_;
    recall(0).stamp = pair.stamp;
    recall(0).image.store(pair.right);
  }

  FrameFault inject(InjectedPair& pair) override {
    pass(pair);
    const FrameTime wanted = pair.stamp - age_;
    const std::int64_t oldest = std::min<std::int64_t>(count_, kKept) - 1;
    std::int64_t back = 0;
    while (back < oldest && recall(back).stamp > wanted) ++back;
    const Duration beyond = wanted - recall(back).stamp;
    if (back == 0 || beyond <= Duration::zero()) {
      copy_pixels(recall(back).image.view(), pair.right);
      return FrameFault::kNone;
    }
    const Duration apart = recall(back - 1).stamp - recall(back).stamp;
    const float share = static_cast<float>(beyond.count()) / static_cast<float>(apart.count());
    mix(recall(back).image.view(), recall(back - 1).image.view(), share, pair.right);
    return FrameFault::kNone;
  }

 private:
  static constexpr std::int64_t kKept = 16;

  struct Taken {
    FrameTime stamp;
    StoredImage image;
  };

  // The right image of the pair that came `back` pairs ago.
  Taken& recall(std::int64_t back) {
    return history_[static_cast<std::size_t>((count_ - 1 - back) % kKept)];
  }

  // (1 − share) · older + share · newer.
  static void mix(const ImageView<const std::uint8_t>& older,
                  const ImageView<const std::uint8_t>& newer, float share,
                  const ImageView<std::uint8_t>& mixed) {
    for (int y = 0; y < mixed.height; ++y) {
      const std::uint8_t* a = older.row(y);
      const std::uint8_t* b = newer.row(y);
      std::uint8_t* row = mixed.row(y);
      for (int x = 0; x < mixed.width; ++x) {
        const auto from = static_cast<float>(a[x]);
        row[x] = to_level(from + share * (static_cast<float>(b[x]) - from));
      }
    }
  }

  Duration age_;
  std::array<Taken, kKept> history_;
  std::int64_t count_ = 0;  // pairs so far
};

}  // namespace

std::unique_ptr<Injector> make_skew(const Injection& injection) {
  return std::make_unique<Skew>(injection);
}

}  // namespace darkling
