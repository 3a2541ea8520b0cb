// SPDX-License-Identifier: Apache-2.0
// The parts of the page about a service that is heard: each a few rows of label and figures.
#pragma once

#include "app/top/heard.h"
#include "app/top/page.h"

namespace darkling {

inline constexpr int kLabelColumns = 11;
inline constexpr int kSectionColumns = 46;  // what all figures fit into, unless they are huge

// A row that begins with `label`.
[[nodiscard]] Row labelled(const char* label, Row figures);

// @param is_fresh  the pose is the vehicle's now; else its speed is not told.
[[nodiscard]] Page pose_section(const Heard& heard, bool is_fresh);
[[nodiscard]] Page frame_section(const status_t& status);
[[nodiscard]] Page camera_section(const status_t& status);
[[nodiscard]] Page service_section(const status_t& status);

// "12.3", "-" when it is not a number.
[[nodiscard]] std::string figure(double value, int decimals);
// "0:01:23", "3 days 0:01:23".
[[nodiscard]] std::string time_text(double seconds);

}  // namespace darkling
