// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

struct ImageSize {
  int width = 0;   // px
  int height = 0;  // px
  bool operator==(const ImageSize&) const = default;
};

}  // namespace darkling
