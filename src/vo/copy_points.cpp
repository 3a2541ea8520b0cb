// SPDX-License-Identifier: Apache-2.0
#include "vo/copy_points.h"

#include <algorithm>

namespace darkling {

void copy_points(const TemplatePoints& from, int capacity, TemplatePoints& to) {
  to.count = std::min(from.count, capacity);
  for (int n = 0; n < to.count; ++n) {
    const int i = spread_index(n, to.count, from.count);
    to.x[n] = from.x[i];
    to.y[n] = from.y[i];
    to.inverse_depth_focal[n] = from.inverse_depth_focal[i];
    to.Sxx[n] = from.Sxx[i];
    to.Sxy[n] = from.Sxy[i];
    to.Syy[n] = from.Syy[i];
    to.patches[n] = from.patches[i];
  }
}

}  // namespace darkling
