// SPDX-License-Identifier: Apache-2.0
// Trajectories that were looked at once and are kept since: a change of the algorithm shows here,
// wanted or not. When it is wanted:
//
//     DARKLING_UPDATE_GOLDEN=1 build/release/bin/test_golden
//
// writes them anew; the difference belongs into the commit that caused it.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "io/trajectory.h"

namespace darkling::test {

// How far apart two processors may be: the functions of their mathematical libraries differ in the
// last bit, and with them now and then a grey level of the rendered images.
struct GoldenTolerance {
  double position_m = 1e-6;
  double rotation_rad = 1e-6;
};

// Whether the poses agree, one by one; says which one does not.
[[nodiscard]] ::testing::AssertionResult agree(const Trajectory& golden, const Trajectory& found,
                                               const GoldenTolerance& tolerance = {});

// The file's text: KITTI rows with nine decimals, a thousandth of the tolerance, so that it stays
// small.
[[nodiscard]] std::string shortened(const Trajectory& trajectory);

// Whether DARKLING_UPDATE_GOLDEN asks for new files.
[[nodiscard]] bool is_update_wanted();

// Compares the KITTI trajectory in the file `found_path` with tests/golden/NAME.txt, or makes it
// that file's new content when DARKLING_UPDATE_GOLDEN is set.
[[nodiscard]] ::testing::AssertionResult is_golden(const std::string& name,
                                                   const std::string& found_path);

}  // namespace darkling::test
