// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "base/result.h"
#include "base/time.h"
#include "io/config.h"

namespace darkling {

struct TopOptions {
  std::string lcm_url = ServiceConfig().lcm_url;
  std::string channel_prefix;
  bool is_once = false;              // print what is heard first, and stop
  bool is_json = false;              // with is_once
  std::optional<Duration> duration;  // without is_once; else until a stop is asked for
};

// Shows how a service is: on a terminal a page that is drawn anew twice a second, elsewhere a line
// a second.
// @return the exit status, or kDeviceUnavailable when no service was heard in the time given.
[[nodiscard]] Result<int> run_top(const TopOptions& options);

}  // namespace darkling
