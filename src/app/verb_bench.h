// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/open_source.h"
#include "base/result.h"
#include "vo/odometry_config.h"

namespace darkling {

// `darkling bench`, its options understood but not yet tried.
struct BenchOptions {
  bool has_kernels = true;
  bool has_stages = true;
  bool has_sweep = false;
  // For the kernels by themselves.
  int width = 320;   // px
  int height = 240;  // px
  // For the others.
  std::string source;
  OpenOptions frames;
  OdometryConfig config;
  std::string kernels;  // an instruction set; empty: all of them, and the best for whole frames
  int repeats = 0;      // 0: as many as each part likes
  bool is_json = false;
};

// Measures and prints. @return the exit status; any Error of the parts.
[[nodiscard]] Result<int> run_bench(const BenchOptions& options);

}  // namespace darkling
