// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>

#include "kernels/bit_planes.h"
#include "kernels/match_patch.h"

namespace darkling {

namespace {

constexpr int kCodeSide = 2 * kCodePatchRadius + 1;
static_assert(kCodeSide == 7, "a row of a patch is seven of the eight bytes that are read");

// Seven codes of a row, from the one at `codes`.
std::uint64_t seven_codes(const std::uint8_t* codes) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, codes, sizeof(eight));
  // The eighth was read last, wherever the processor keeps it.
  return std::endian::native == std::endian::little ? eight << 8 : eight >> 8;
}

}  // namespace

void match_codes_ref(const std::uint8_t* left, std::ptrdiff_t left_stride,
                     const std::uint8_t* right, std::ptrdiff_t right_stride, int count, int* cost) {
  for (int k = 0; k < count; ++k) {
    int sum = 0;
    for (int j = -kCodePatchRadius; j <= kCodePatchRadius; ++j) {
      sum += std::popcount(seven_codes(left + j * left_stride - kCodePatchRadius) ^
                           seven_codes(right + j * right_stride - kCodePatchRadius - k));
    }
    cost[k] = sum;
  }
}

PatchFit compare_patch_ref(const std::uint8_t* left, std::ptrdiff_t left_stride,
                           const std::uint8_t* right, std::ptrdiff_t right_stride,
                           int fraction_q12) {
  constexpr int kFirst = -kPlanePatchRadius * kPlaneCount;
  constexpr int kLast = (kPlanePatchRadius + 1) * kPlaneCount;
  PatchFit fit;
  for (int j = -kPlanePatchRadius; j <= kPlanePatchRadius; ++j) {
    const std::uint8_t* l = left + j * left_stride;
    const std::uint8_t* r = right + j * right_stride;
    for (int i = kFirst; i < kLast; ++i) {
      const int value = (4096 - fraction_q12) * r[i] + fraction_q12 * r[i + kPlaneCount];
      const int residual = ((value + 128) >> 8) - 16 * l[i];
      const int g = l[i + kPlaneCount] - l[i - kPlaneCount];
      fit.gr += g * residual;
      fit.gg += g * g;
      fit.rr += residual * residual;
    }
  }
  return fit;
}

}  // namespace darkling
