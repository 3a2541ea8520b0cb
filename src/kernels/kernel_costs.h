// SPDX-License-Identifier: Apache-2.0
// What every kernel has to do at least, counted by hand from its contract, so that a measured time
// can be held against what a processor could do at best.
//
// Bytes: what the contract reads and writes, every array once a pass, whatever level of the cache
// it lies in; rows of scratch that the contract says stay in cache are left out.
// Operations: additions, subtractions, multiplications, comparisons, minima, shifts and bitwise
// combinations of numbers, each as many *byte operations* as its operands have bytes, because a
// vector holds so many fewer of them. As instruction sets have them in one, a product of integers
// or an absolute difference counts together with the sum it goes into. Counting the bits of a byte
// is one. Operations on floats are counted apart, one each, divisions too. Loading, storing,
// widening and shuffling are free: they are what a variant is allowed to be clever about.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/bit_planes.h"
#include "kernels/match_patch.h"
#include "kernels/sample_residuals.h"
#include "kernels/semi_global.h"

namespace darkling {

// In the order of KernelTable.
enum class Kernel : std::uint8_t {
  kRemapArea,
  kHalve,
  kBitPlanes,
  kSaliency,
  kSampleResiduals,
  kNormalEquations,
  kHammingRow,
  kSemiGlobalRow,
  kMatchCodes,
  kComparePatch,
  kTakePatch,
};
inline constexpr int kKernelCount = 11;

struct KernelName {
  const char* name;
  const char* unit;  // what costs are counted for: one output pixel, one point, one candidate
};
inline constexpr std::array<KernelName, kKernelCount> kKernelNames = {{
    {"remap_area", "pixel"},
    {"halve", "pixel"},
    {"bit_planes", "pixel"},
    {"saliency", "pixel"},
    {"sample_residuals", "point"},
    {"normal_equations", "point"},
    {"hamming_row", "pixel"},
    {"semi_global_row", "pixel"},
    {"match_codes", "candidate"},
    {"compare_patch", "candidate"},
    {"take_patch", "point"},
}};
[[nodiscard]] constexpr const KernelName& name_of(Kernel kernel) {
  return kKernelNames[static_cast<std::size_t>(kernel)];
}

// Of one unit.
struct KernelCost {
  double bytes = 0.0;
  double byte_operations = 0.0;
  double float_operations = 0.0;
};

// Reads 8 bytes of map and the box of source pixels, writes one. taps² products of bytes along the
// rows, as many products of 16 bits as taps down the column, a shift of 32 bits; rounding is where
// the sum begins.
[[nodiscard]] constexpr KernelCost remap_area_cost(int taps, double box_px) {
  return {8.0 + box_px * box_px + 1.0, 1.0 * taps * taps + 2.0 * taps + 4.0, 0.0};
}

// Four pixels in, one out. Two sums of bytes; their sum, the rounding and a shift, of 16 bits.
[[nodiscard]] constexpr KernelCost halve_cost() {
  return {5.0, 2.0 + 2.0 * 3, 0.0};
}

// A grey level in, a code and eight planes out, as far as wanted. Blur: each column's sum once (3),
// then along the row (3), rounding and shift, of 16 bits. Census: eight comparisons, each put into
// its bit. Planes: a bit picked out and spread, eight times. Smoothing: six times two averages of
// eight planes.
[[nodiscard]] constexpr KernelCost bit_planes_cost(bool has_codes, bool has_planes) {
  const double codes = 2.0 * 8 + 4.0 * 8;
  const double planes = 5.0 * kPlaneCount + 6.0 * 2 * kPlaneCount;
  return {1.0 + (has_codes ? 1.0 : 0.0) + (has_planes ? kPlaneCount : 0.0),
          codes + (has_planes ? planes : 0.0), 0.0};
}

// Eight planes in, 16 bits out. Sixteen absolute differences of bytes, summed.
[[nodiscard]] constexpr KernelCost saliency_cost() {
  return {kPlaneCount + 2.0, 2.0 * kPlaneCount, 0.0};
}

// In: three floats and the patch of a point, four pixels of the frame; out: three floats.
// Position: 18 to move the point, 6 to project it, 5 comparisons, 2 units and 2 conversions; the
// three results are scaled. Weights: 12 of 32 bits. A plane: 4 products of 16 bits, a rounded shift
// of 32; the reference shifted and taken off, three products, of 16.
[[nodiscard]] constexpr KernelCost sample_residuals_cost() {
  constexpr double kPlane = 2.0 * 4 + 4.0 * 2 + 2.0 * 2 + 2.0 * 3;
  return {12.0 + 40.0 + 4.0 * kPlaneCount + 12.0, 4.0 * 12 + kPlaneCount * kPlane, 33.0 + 3.0};
}

// In: six floats of a point and three of its residual. Weight 5, position 3, Jacobian 12, weighted
// S and b 5; S J 6 · 6, H 21 · 4, g 6 · 4, structural zeros of J counted as the contract's order of
// additions has them.
[[nodiscard]] constexpr KernelCost normal_equations_cost() {
  return {36.0, 0.0, 5.0 + 3 + 12 + 5 + 36 + 84 + 24};
}

// Two codes in, 32 costs out; each an exclusive-or and a count of bits.
[[nodiscard]] constexpr KernelCost hamming_row_cost() {
  return {2.0 + kDisparities, 2.0 * kDisparities, 0.0};
}

// A disparity reads three rows of Hamming distances, writes its matching cost and reads it again on
// the way back, reads and writes three path costs with their minima, and writes, reads and writes
// its 16-bit sum; the winners are 4 bytes. Window: 4 sums. Five paths: two minima of three and one
// more, two sums, a difference, the running minimum: 7 each. Sums of 16 bits: 4; keys: 2; winners:
// a minimum each.
[[nodiscard]] constexpr KernelCost semi_global_row_cost() {
  constexpr double kBytes = 3 + 2 + 3 * 2 + 3 * 2;
  constexpr double kOperations = 4 + 5 * 7 + 2.0 * (4 + 2 + 2);
  return {kDisparities * kBytes + 3 * 2 + 4, kDisparities * kOperations, 0.0};
}

// A patch of the left eye and the strip of the right one that `count` disparities reach; out, a
// 32-bit cost each. A code: exclusive-or, count of bits, sum.
[[nodiscard]] constexpr KernelCost match_codes_cost(int count) {
  constexpr int kSide = 2 * kCodePatchRadius + 1;
  return {kSide * kSide + kSide * (kSide + count - 1.0) + 4.0 * count, 3.0 * kSide * kSide * count,
          0.0};
}

// The patch of the left eye with a pixel to either side, of the right one with one more; out, three
// sums. A value: two products of 16 bits, a rounded shift of 32; the left one shifted and taken
// off, the gradient, three products, of 16.
[[nodiscard]] constexpr KernelCost compare_patch_cost() {
  constexpr int kSide = 2 * kPlanePatchRadius + 1;
  constexpr double kValue = 2.0 * 2 + 4.0 * 2 + 2.0 * 3 + 2.0 * 3;
  return {kSide * kPlaneCount * (2.0 * kSide + 3.0) + 12.0, kPlanePatchValues * kValue, 0.0};
}

// Five pixels of planes in, a patch and three sums out. A plane: two differences and three products
// of 16 bits.
[[nodiscard]] constexpr KernelCost take_patch_cost() {
  return {5.0 * kPlaneCount + sizeof(PlanePatch) + 12.0, 2.0 * 5 * kPlaneCount, 0.0};
}

}  // namespace darkling
