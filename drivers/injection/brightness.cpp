// SPDX-License-Identifier: Apache-2.0
// Injections that treat every pixel of a level alike.
#include "drivers/injection/light.h"
#include "drivers/injection/pixels.h"

namespace darkling {

namespace {

void multiply(float factor, InjectedPair& pair) {
  LevelMap map;
  for (std::size_t v = 0; v < map.size(); ++v) map[v] = to_level(factor * static_cast<float>(v));
  map_levels(map, pair.left);
  map_levels(map, pair.right);
}

class Gain final : public Injector {
 public:
  explicit Gain(const Injection& injection) : factor_(static_cast<float>(injection.value)) {}

  FrameFault inject(InjectedPair& pair) override {
    multiply(factor_, pair);
    return FrameFault::kNone;
  }

 private:
  float factor_;
};

}  // namespace

std::unique_ptr<Injector> make_gain(const Injection& injection) {
  return std::make_unique<Gain>(injection);
}

}  // namespace darkling
