// SPDX-License-Identifier: Apache-2.0
#include "vo/check_limits.h"

#include <string>

#include "vo/limits.h"

namespace darkling {

namespace {

struct Limit {
  const char* name;
  int value;
};

Result<void> check_between(const std::string& what, int found, const char* unit, Limit least,
                           Limit most) {
  const auto refuse = [&](const char* relation, const Limit& limit) {
    return failure(ExitCode::kConfiguration, what + " " + std::to_string(found) + unit + " is " +
                                                 relation + " " + limit.name + " = " +
                                                 std::to_string(limit.value));
  };
  if (found < least.value) return refuse("below", least);
  if (found > most.value) return refuse("above", most);
  return {};
}

}  // namespace

Result<void> check_limits(const OdometryConfig& config, int width_px, int height_px) {
  const std::string height =
      "thumbnail height, which follows from a width of " + std::to_string(width_px) + " px,";
  return check_between("thumbnail width", width_px, " px", {"kMinWidth", kMinWidth},
                       {"kMaxWidth", kMaxWidth})
      .and_then([&] {
        return check_between(height, height_px, " px", {"kMinHeight", kMinHeight},
                             {"kMaxHeight", kMaxHeight});
      })
      .and_then([&] {
        return check_between("points_per_level", config.points_per_level, "",
                             {"kMinPointsPerLevel", kMinPointsPerLevel},
                             {"kMaxPointsPerLevel", kMaxPointsPerLevel});
      });
}

}  // namespace darkling
