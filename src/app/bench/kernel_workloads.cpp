// SPDX-License-Identifier: Apache-2.0
#include "app/bench/kernel_workloads.h"

#include <string>

#include "app/bench/held_frames.h"
#include "app/bench/kernel_inputs.h"
#include "vo/limits.h"

namespace darkling {

namespace {

constexpr SemiGlobalPenalties kPenalties = {.small_step = 8, .large_step = 32};

int pixels_of(const ImageView<std::uint8_t>& image) {
  return image.width * image.height;
}

void add_image_kernels(KernelInputs& in, std::vector<KernelWorkload>& list) {
  PyramidLevel& level = in.left[0];
  const int pixels = pixels_of(level.grey);
  list.push_back(
      {Kernel::kRemapArea, pixels, remap_area_cost(in.left_map.taps, in.left_map.box_px),
       [&](const KernelTable& t) { t.remap_area(in.left_map, in.raw_left, level.grey); }});
  // A pyramid of one level halves nothing: its own image is the next best.
  const ImageView<std::uint8_t> half(in.left.size() > 1 ? in.left[1].grey : in.right[0].grey);
  const ImageView<std::uint8_t> halved(half.data, level.grey.width / 2, level.grey.height / 2,
                                       half.stride);
  list.push_back({Kernel::kHalve, pixels_of(halved), halve_cost(),
                  [&, halved](const KernelTable& t) { t.halve(level.grey, halved); }});
  list.push_back(
      {Kernel::kBitPlanes, pixels, bit_planes_cost(true, true), [&](const KernelTable& t) {
         t.bit_planes(level.grey, level.dead_zone, level.codes, in.plane_scratch, level.planes);
       }});
  list.push_back({Kernel::kSaliency, pixels, saliency_cost(),
                  [&](const KernelTable& t) { t.saliency(level.planes, in.selector.saliency); }});
}

void add_point_kernels(KernelInputs& in, std::vector<KernelWorkload>& list) {
  const TemplatePoints& points = in.keyframe.levels[0].points;
  list.push_back(
      {Kernel::kSampleResiduals, points.count, sample_residuals_cost(), [&](const KernelTable& t) {
         (void)t.sample_residuals(points, in.warp, in.left[0].planes, in.residuals);
       }});
  list.push_back(
      {Kernel::kNormalEquations, points.count, normal_equations_cost(), [&](const KernelTable& t) {
         NormalSums sums;
         t.normal_equations(points, in.residuals, in.warp.focal_px, 1e-4f, sums);
         in.normal_sums = sums;
       }});
}

// One row each, of the level that is matched densely.
void add_row_kernels(KernelInputs& in, std::vector<KernelWorkload>& list) {
  const ImageView<std::uint8_t>& codes = in.left[in.disparities.dense_level].codes;
  const int width = codes.width;
  list.push_back(
      {Kernel::kHammingRow, width, hamming_row_cost(), [&in, codes, width](const KernelTable& t) {
         t.hamming_row(codes.row(codes.height / 2), in.matcher.right_reversed, width,
                       in.matcher.hamming_rows);
       }});
  list.push_back(
      {Kernel::kSemiGlobalRow, width, semi_global_row_cost(), [&in, width](const KernelTable& t) {
         const std::uint8_t* const first = in.matcher.hamming_rows;
         const std::uint8_t* const rows[3] = {first, first + width * kDisparities,
                                              first + 2 * width * kDisparities};
         t.semi_global_row(rows, kPenalties, in.matcher.paths, in.matcher.row);
       }});
}

void add_candidate_kernels(KernelInputs& in, std::vector<KernelWorkload>& list) {
  list.push_back({Kernel::kMatchCodes, static_cast<int>(in.code_candidates.size()),
                  match_codes_cost(in.search_count), [&](const KernelTable& t) {
                    for (const CodeCandidate& c : in.code_candidates) {
                      t.match_codes(c.left, in.left[0].codes.stride, c.right,
                                    in.right[0].codes.stride, in.search_count,
                                    in.search_costs.data());
                    }
                  }});
  list.push_back({Kernel::kComparePatch, static_cast<int>(in.plane_candidates.size()),
                  compare_patch_cost(), [&](const KernelTable& t) {
                    for (const PlaneCandidate& c : in.plane_candidates) {
                      in.patch_fit = t.compare_patch(c.left, in.left[0].planes.stride, c.right,
                                                     in.right[0].planes.stride, c.fraction_q12);
                    }
                  }});
  list.push_back({Kernel::kTakePatch, static_cast<int>(in.plane_candidates.size()),
                  take_patch_cost(), [&](const KernelTable& t) {
                    for (const PlaneCandidate& c : in.plane_candidates) {
                      (void)t.take_patch(c.left, in.left[0].planes.stride, in.patch);
                    }
                  }});
}

}  // namespace

KernelWorkloads::KernelWorkloads(std::unique_ptr<KernelInputs> inputs)
    : inputs_(std::move(inputs)) {
  add_image_kernels(*inputs_, workloads_);
  add_point_kernels(*inputs_, workloads_);
  add_row_kernels(*inputs_, workloads_);
  add_candidate_kernels(*inputs_, workloads_);
}
KernelWorkloads::KernelWorkloads(KernelWorkloads&&) noexcept = default;
KernelWorkloads::~KernelWorkloads() = default;
int KernelWorkloads::width() const {
  return inputs_->rig.width;
}
int KernelWorkloads::height() const {
  return inputs_->rig.height;
}

Result<KernelWorkloads> KernelWorkloads::create(const StereoRig& rig, const StereoFrame& frame,
                                                const OdometryConfig& config) {
  auto inputs = make_kernel_inputs(rig, frame, config);
  if (!inputs) return tl::unexpected(inputs.error());
  return KernelWorkloads(std::move(*inputs));
}

Result<KernelWorkloads> KernelWorkloads::create_rendered(int width, int height, int points) {
  const std::string source = "synthetic:corridor,frames=1,width=" + std::to_string(2 * width) +
                             ",height=" + std::to_string(2 * height);
  const auto held = hold_frames(source, {}, [](std::int64_t, std::int64_t) {});
  if (!held) return tl::unexpected(held.error());
  return create(held->rig, held->frames.front(), {.width_px = width, .points_per_level = points});
}

std::vector<KernelTable> available_tables(const CpuFeatures& cpu) {
  std::vector<KernelTable> tables;
  for (const char* name : {"ref", "sse41", "avx2", "neon"}) {
    const auto table = select_kernels(name, cpu);
    if (table) tables.push_back(*table);
  }
  return tables;
}

}  // namespace darkling
