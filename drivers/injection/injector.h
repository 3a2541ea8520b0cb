// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/image_size.h"
#include "base/image_view.h"
#include "base/time.h"
#include "drivers/frame_source.h"

namespace darkling {

// A pair on its way through the injections, which change its pixels in place.
struct InjectedPair {
  std::int64_t sequence = 0;
  FrameTime stamp;
  ImageView<std::uint8_t> left;
  ImageView<std::uint8_t> right;
};

// Makes one thing go wrong. What it makes of a pair depends on its Injection, the pair's sequence
// and pixels and, of some, on pairs before; never on time or thread.
// Thread: the one that waits for frames.
class Injector {
 public:
  virtual ~Injector() = default;
  // Claims all memory for images of `size` and forgets the pairs before.
  virtual void start(ImageSize /*size*/) {}
  // A pair outside of the injection's range, which stays as it is.
  virtual void pass(const InjectedPair& /*pair*/) {}
  // A pair in range. @return kNone, or why the pair is lost.
  virtual FrameFault inject(InjectedPair& pair) = 0;
};

}  // namespace darkling
