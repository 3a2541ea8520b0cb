// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "drivers/injection/pixels.h"
#include "drivers/injection/view.h"
#include "drivers/injection/wander.h"

namespace darkling {

namespace {

// A rough board before the cameras, with the sides of the image in proportion and `value` of its
// area, that wanders about inside of the left image. It is flat and faces the cameras, at a
// disparity of a twelfth of the image's width; its mean is the pair's.
class Occluder final : public Injector {
 public:
  explicit Occluder(const Injection& injection) : injection_(injection), texture_(kSide * kSide) {
    paint(32, 0.65f);
    paint(8, 0.35f);
  }

  FrameFault inject(InjectedPair& pair) override {
    const auto mean = static_cast<float>(0.5 * (mean_level(pair.left) + mean_level(pair.right)));
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      levels_[i] = to_level(mean * (0.2f + 1.6f * static_cast<float>(i) / 255.0f));
    }
    const WanderedTo place = wander(injection_, pair.sequence);
    const double side = std::sqrt(injection_.value);
    Board board;
    board.width = static_cast<int>(std::lround(side * pair.left.width));
    board.height = static_cast<int>(std::lround(side * pair.left.height));
    board.left =
        static_cast<int>(std::lround(0.5 * (1.0 + place.x) * (pair.left.width - board.width)));
    board.top =
        static_cast<int>(std::lround(0.5 * (1.0 + place.y) * (pair.left.height - board.height)));
    draw(board, pair.left);
    board.left -= pair.left.width / 12;
    draw(board, pair.right);
    return FrameFault::kNone;
  }

 private:
  static constexpr int kSide = 256;  // px, of the texture, which repeats

  struct Board {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
  };

  // Adds bilinear noise of one value every `cell` px.
  void paint(int cell, float weight) {
    const int cells = kSide / cell;
    const std::uint64_t key = noise_key(injection_, 0, cell);
    const auto node = [&](int i, int j) {
      const int index = (j % cells) * cells + i % cells;
      return unit_float(static_cast<std::uint32_t>(mix64(key + static_cast<std::uint64_t>(index))));
    };
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const int i = x / cell;
        const int j = y / cell;
        const float u = static_cast<float>(x % cell) / static_cast<float>(cell);
        const float v = static_cast<float>(y % cell) / static_cast<float>(cell);
        const float above = node(i, j) + u * (node(i + 1, j) - node(i, j));
        const float below = node(i, j + 1) + u * (node(i + 1, j + 1) - node(i, j + 1));
        const float level = 255.0f * weight * (above + v * (below - above));
        std::uint8_t& pixel = texture_[static_cast<std::size_t>(y * kSide + x)];
        pixel = to_level(static_cast<float>(pixel) + level);
      }
    }
  }

  void draw(const Board& board, const ImageView<std::uint8_t>& image) const {
    const int first = std::max(board.left, 0);
    const int end = std::min(board.left + board.width, image.width);
    for (int y = board.top; y < board.top + board.height; ++y) {
      std::uint8_t* row = image.row(y);
      const std::uint8_t* texture = texture_.data() + (y - board.top) % kSide * kSide;
      for (int x = first; x < end; ++x) row[x] = levels_[texture[(x - board.left) % kSide]];
    }
  }

  Injection injection_;
  std::vector<std::uint8_t> texture_;  // kSide x kSide
  LevelMap levels_ = {};               // of the texture, in this pair's light
};

}  // namespace

std::unique_ptr<Injector> make_occlude(const Injection& injection) {
  return std::make_unique<Occluder>(injection);
}

}  // namespace darkling
