// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "base/spsc_ring.h"
#include "base/time.h"
#include "geometry/se3.h"

namespace darkling {

// What the odometry is asked to do before the next frame.
struct Wish {
  enum class Kind { kNone = 0, kReset, kReseed, kHint };
  Kind kind = Kind::kNone;
  Se3 T_previous_body = {};  // of kHint: Body's motion …
  Duration span = {};        // … in so much time
};

inline constexpr std::size_t kWishRingSize = 16;
using WishRing = SpscRing<Wish, kWishRingSize>;

}  // namespace darkling
