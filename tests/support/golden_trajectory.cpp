// SPDX-License-Identifier: Apache-2.0
#include "support/golden_trajectory.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "support/project_folder.h"
#include "support/temporary_folder.h"

namespace darkling::test {

bool is_update_wanted() {
  const char* value = std::getenv("DARKLING_UPDATE_GOLDEN");
  return value != nullptr && std::string(value) == "1";
}

std::string shortened(const Trajectory& trajectory) {
  std::ostringstream text;
  text << "# rows of a KITTI trajectory, rounded; written by DARKLING_UPDATE_GOLDEN=1 test_golden\n"
       << std::fixed;
  text.precision(9);
  for (const TimedPose& pose : trajectory.poses) {
    const auto rows = pose.T_world_pose.matrix().topRows<3>();
    for (int i = 0; i < 12; ++i) text << rows(i / 4, i % 4) << (i == 11 ? "\n" : " ");
  }
  return text.str();
}

::testing::AssertionResult agree(const Trajectory& golden, const Trajectory& found,
                                 const GoldenTolerance& tolerance) {
  if (golden.poses.size() != found.poses.size()) {
    return ::testing::AssertionFailure()
           << found.poses.size() << " poses instead of " << golden.poses.size();
  }
  for (std::size_t i = 0; i < golden.poses.size(); ++i) {
    const Eigen::Matrix4d difference =
        golden.poses[i].T_world_pose.matrix() - found.poses[i].T_world_pose.matrix();
    const double position_m = difference.topRightCorner<3, 1>().norm();
    // |ΔR| of a small rotation is √2 times its angle.
    const double rotation_rad = difference.topLeftCorner<3, 3>().norm() / std::sqrt(2.0);
    if (!(position_m <= tolerance.position_m && rotation_rad <= tolerance.rotation_rad)) {
      return ::testing::AssertionFailure() << "pose " << i << " is " << position_m << " m and "
                                           << rotation_rad << " rad from the golden one";
    }
  }
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult is_golden(const std::string& name, const std::string& found_path) {
  const std::string golden_path = project_folder() + "/tests/golden/" + name + ".txt";
  const Result<Trajectory> found = read_trajectory(found_path);
  if (!found) return ::testing::AssertionFailure() << found.error().message;
  if (is_update_wanted()) {
    write_text(golden_path, shortened(*found));
    return ::testing::AssertionSuccess() << "wrote " << golden_path;
  }
  const Result<Trajectory> golden = read_trajectory(golden_path);
  if (!golden) return ::testing::AssertionFailure() << golden.error().message;
  return agree(*golden, *found);
}

}  // namespace darkling::test
