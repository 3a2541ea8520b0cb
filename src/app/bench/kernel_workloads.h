// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/cpu_features.h"
#include "base/result.h"
#include "base/stereo_frame.h"
#include "geometry/stereo_rig.h"
#include "kernels/kernel_costs.h"
#include "kernels/kernel_table.h"
#include "vo/odometry_config.h"

namespace darkling {

struct KernelInputs;

// One kernel with inputs as the odometry gives it.
struct KernelWorkload {
  Kernel kernel = Kernel::kRemapArea;
  int units = 0;    // pixels, points or candidates that one run() goes over
  KernelCost cost;  // of one of them
  std::function<void(const KernelTable& table)> run;

  // The memory that one run() goes through.
  [[nodiscard]] double working_set_bytes() const { return units * cost.bytes; }
};

// Every kernel at work on one frame, its inputs taken from a keyframe made of that frame: the same
// map, levels, points and disparities as in the odometry.
class KernelWorkloads {
 public:
  // @return kConfiguration when the rig makes no sense or gives no thumbnail of that width;
  // kBadInput
  //         when the frame shows too little to find points in.
  [[nodiscard]] static Result<KernelWorkloads> create(const StereoRig& rig,
                                                      const StereoFrame& frame,
                                                      const OdometryConfig& config);
  // The same on a rendered corridor, of cameras twice as wide and high as the thumbnail.
  // @return kUsage when there is no such image.
  [[nodiscard]] static Result<KernelWorkloads> create_rendered(int width, int height, int points);

  KernelWorkloads(KernelWorkloads&&) noexcept;
  ~KernelWorkloads();

  [[nodiscard]] std::span<const KernelWorkload> all() const { return workloads_; }
  [[nodiscard]] int width() const;   // px, of the thumbnail
  [[nodiscard]] int height() const;  // px

 private:
  explicit KernelWorkloads(std::unique_ptr<KernelInputs> inputs);

  std::unique_ptr<KernelInputs> inputs_;
  std::vector<KernelWorkload> workloads_;  // in the order of Kernel
};

// The tables of this processor, ref first.
[[nodiscard]] std::vector<KernelTable> available_tables(const CpuFeatures& cpu);

}  // namespace darkling
