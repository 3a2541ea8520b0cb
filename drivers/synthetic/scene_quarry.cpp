// SPDX-License-Identifier: Apache-2.0
#include "drivers/synthetic/scene.h"
namespace darkling::synthetic {
Scene make_quarry(const RoverPath& path, std::uint32_t seed) {
  return make_mine(path, seed);
}
}  // namespace darkling::synthetic
