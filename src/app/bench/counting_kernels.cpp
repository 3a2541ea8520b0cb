// SPDX-License-Identifier: Apache-2.0
#include "app/bench/counting_kernels.h"

#include <utility>

namespace darkling {

namespace {

static_assert(sizeof(KernelTable) == (1 + kKernelCount) * sizeof(void*),
              "every kernel of the table is counted");

// Kernels are plain functions, so what they note and whom they call is of the whole process.
KernelTable counted;
FrameWork work;

void note(Kernel kernel, double units, const KernelCost& cost) {
  KernelWork& of = work[static_cast<std::size_t>(kernel)];
  of.units += units;
  of.total.bytes += units * cost.bytes;
  of.total.byte_operations += units * cost.byte_operations;
  of.total.float_operations += units * cost.float_operations;
}

template <class T>
double pixels_of(const ImageView<T>& image) {
  return static_cast<double>(image.width) * image.height;
}

void remap_area(const AreaMap& map, ImageView<const std::uint8_t> src,
                ImageView<std::uint8_t> dst) {
  note(Kernel::kRemapArea, pixels_of(dst), remap_area_cost(map.taps, map.box_px));
  counted.remap_area(map, src, dst);
}

void halve(ImageView<const std::uint8_t> src, ImageView<std::uint8_t> dst) {
  note(Kernel::kHalve, pixels_of(dst), halve_cost());
  counted.halve(src, dst);
}

void bit_planes(ImageView<const std::uint8_t> grey, int dead_zone, ImageView<std::uint8_t> codes,
                std::span<std::uint8_t> scratch, ImageView<std::uint8_t> planes) {
  note(Kernel::kBitPlanes, pixels_of(grey), bit_planes_cost(!codes.is_empty(), !planes.is_empty()));
  counted.bit_planes(grey, dead_zone, codes, scratch, planes);
}

void saliency(ImageView<const std::uint8_t> planes, ImageView<std::uint16_t> dst) {
  note(Kernel::kSaliency, pixels_of(dst), saliency_cost());
  counted.saliency(planes, dst);
}

int sample_residuals(const TemplatePoints& points, const PointWarp& warp,
                     ImageView<const std::uint8_t> planes, const PointResiduals& out) {
  note(Kernel::kSampleResiduals, points.count, sample_residuals_cost());
  return counted.sample_residuals(points, warp, planes, out);
}

void normal_equations(const TemplatePoints& points, const PointResiduals& residuals, float focal_px,
                      float inverse_scale, NormalSums& sums) {
  note(Kernel::kNormalEquations, points.count, normal_equations_cost());
  counted.normal_equations(points, residuals, focal_px, inverse_scale, sums);
}

void hamming_row(const std::uint8_t* left, const std::uint8_t* right_reversed, int width,
                 std::uint8_t* cost) {
  note(Kernel::kHammingRow, width, hamming_row_cost());
  counted.hamming_row(left, right_reversed, width, cost);
}

void semi_global_row(const std::uint8_t* const hamming[3], SemiGlobalPenalties penalties,
                     PathRows& paths, const StereoRow& row) {
  note(Kernel::kSemiGlobalRow, paths.width, semi_global_row_cost());
  counted.semi_global_row(hamming, penalties, paths, row);
}

void match_codes(const std::uint8_t* left, std::ptrdiff_t left_stride, const std::uint8_t* right,
                 std::ptrdiff_t right_stride, int count, int* cost) {
  note(Kernel::kMatchCodes, 1.0, match_codes_cost(count));
  counted.match_codes(left, left_stride, right, right_stride, count, cost);
}

PatchFit compare_patch(const std::uint8_t* left, std::ptrdiff_t left_stride,
                       const std::uint8_t* right, std::ptrdiff_t right_stride, int fraction_q12) {
  note(Kernel::kComparePatch, 1.0, compare_patch_cost());
  return counted.compare_patch(left, left_stride, right, right_stride, fraction_q12);
}

GramMatrix4 take_patch(const std::uint8_t* planes, std::ptrdiff_t stride, PlanePatch& patch) {
  note(Kernel::kTakePatch, 1.0, take_patch_cost());
  return counted.take_patch(planes, stride, patch);
}

}  // namespace

KernelTable counting_kernels(const KernelTable& table) {
  counted = table;
  return {.name = table.name,
          .remap_area = remap_area,
          .halve = halve,
          .bit_planes = bit_planes,
          .saliency = saliency,
          .take_patch = take_patch,
          .sample_residuals = sample_residuals,
          .normal_equations = normal_equations,
          .hamming_row = hamming_row,
          .semi_global_row = semi_global_row,
          .match_codes = match_codes,
          .compare_patch = compare_patch};
}

FrameWork take_counted_work() {
  return std::exchange(work, FrameWork{});
}

}  // namespace darkling
