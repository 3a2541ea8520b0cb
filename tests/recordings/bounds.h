// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace darkling::test {

// What a run's statistics may be at most; no frame may be lost, and some must have been played.
struct Bounds {
  std::optional<double> drift_percent = {};
  std::optional<double> drift_deg_per_m = {};
  std::optional<double> ate_rmse_m = {};
  std::optional<double> rpe_rmse_m = {};
  std::optional<double> nees_motion = {};  // and at least 0.3, so for poses
  std::optional<double> nees_pose = {};
};

// Whether `stats` (--stats of replay) keep the bounds; a figure that is absent or null does not.
[[nodiscard]] inline ::testing::AssertionResult are_kept(const Bounds& bounds,
                                                         const nlohmann::json& stats) {
  const std::pair<const char*, std::optional<double>> limits[] = {
      {"drift_percent", bounds.drift_percent},
      {"drift_deg_per_m", bounds.drift_deg_per_m},
      {"ate_rmse_m", bounds.ate_rmse_m},
      {"rpe_rmse_m", bounds.rpe_rmse_m},
      {"nees_motion", bounds.nees_motion},
      {"nees_pose", bounds.nees_pose},
      {"lost_frames", 0.0},
      {"resets", 0.0}};
  for (const auto& [key, limit] : limits) {
    if (!limit) continue;
    const nlohmann::json value = stats.value(key, nlohmann::json());
    if (!value.is_number() || !(value.get<double>() <= *limit)) {
      return ::testing::AssertionFailure()
             << key << " is " << value.dump() << ", at most " << *limit << " is allowed";
    }
  }
  for (const char* key : {"nees_motion", "nees_pose"}) {
    const nlohmann::json value = stats.value(key, nlohmann::json());
    if (value.is_number() && value.get<double>() < 0.3 && bounds.nees_motion) {
      return ::testing::AssertionFailure() << key << " is " << value.dump() << ", less than 0.3";
    }
  }
  if (stats.value("frames", 0) > 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "no frame was played";
}

}  // namespace darkling::test
