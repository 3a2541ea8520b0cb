// SPDX-License-Identifier: Apache-2.0
#include "kernels/take_patch.h"

namespace darkling {

GramMatrix4 take_patch_ref(const std::uint8_t* planes, std::ptrdiff_t stride, PlanePatch& patch) {
  GramMatrix4 S4;
  for (int c = 0; c < kPlaneCount; ++c) {
    const std::uint8_t* here = planes + c;
    const int gx2 = here[kPlaneCount] - here[-kPlaneCount];
    const int gy2 = here[stride] - here[-stride];
    patch.reference[c] = *here;
    patch.gx2[c] = static_cast<std::int16_t>(gx2);
    patch.gy2[c] = static_cast<std::int16_t>(gy2);
    S4.xx += gx2 * gx2;
    S4.xy += gx2 * gy2;
    S4.yy += gy2 * gy2;
  }
  return S4;
}

}  // namespace darkling
