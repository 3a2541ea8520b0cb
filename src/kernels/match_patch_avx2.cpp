// SPDX-License-Identifier: Apache-2.0
#include "kernels/match_patch.h"

namespace darkling {
namespace {

constexpr int kCodeRows = 2 * kCodePatchRadius + 1;
constexpr unsigned long long kSevenBytes = 0x00ff'ffff'ffff'ffffULL;

unsigned long long eight_codes(const std::uint8_t* codes) {
  unsigned long long eight = 0;
  __builtin_memcpy(&eight, codes, sizeof(eight));
  return eight;
}

}  // namespace

void match_codes_avx2(const std::uint8_t* left, std::ptrdiff_t left_stride,
                      const std::uint8_t* right, std::ptrdiff_t right_stride, int count,
                      int* cost) {
  unsigned long long patch[kCodeRows];
  const std::uint8_t* rows[kCodeRows];
  for (int j = 0; j < kCodeRows; ++j) {
    const int dy = j - kCodePatchRadius;
    patch[j] = eight_codes(left + dy * left_stride - kCodePatchRadius);
    rows[j] = right + dy * right_stride - kCodePatchRadius;
  }
  for (int k = 0; k < count; ++k) {
    int sum = 0;
    for (int j = 0; j < kCodeRows; ++j) {
      sum += __builtin_popcountll((patch[j] ^ eight_codes(rows[j] - k)) & kSevenBytes);
    }
    cost[k] = sum;
  }
}

}  // namespace darkling
