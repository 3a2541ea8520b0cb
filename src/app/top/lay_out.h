// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/top/draw_map.h"
#include "app/top/heard.h"
#include "app/top/page.h"
#include "base/time.h"

namespace darkling {

// What is known besides what was heard.
struct View {
  std::string url;
  std::string prefix;
  MonotonicTime now;
  MonotonicTime started_at;  // to listen
  Glyphs glyphs = Glyphs::kAscii;
  bool has_map = true;  // and is 80 columns wide; else lines may be longer
};

inline constexpr int kPageColumns = 80;
inline constexpr int kPageRows = 24;
// Statuses come twice a second: so old, the last one tells nothing about now.
inline constexpr Duration kSilence = std::chrono::seconds(2);

// The page that says how the service is, most important first: kPageRows rows at most.
[[nodiscard]] Page lay_out(const Heard& heard, const View& view);

// Why nothing may have been heard, and what to do, one or more lines.
[[nodiscard]] std::string explain_silence(const Heard& heard, const View& view);

// How the service is in one line, for a log: "TRACKING quality 72 in 20.0 Hz …".
[[nodiscard]] std::string one_line(const Heard& heard, const View& view);

}  // namespace darkling
