// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/top/track.h"

namespace darkling {

// What a terminal can show: braille patterns of eight dots a character, or ASCII.
enum class Glyphs { kAscii = 0, kUnicode };

// The track seen from above, as large as it fits: World's x up, its y to the left. 'o' (○) is where
// it began, '@' (●) where it ends. Below is a bar with its length in m.
// @return `rows` lines of at most `columns`.
// @pre columns >= 20, rows >= 3.
[[nodiscard]] std::vector<std::string> draw_map(const Track& track, int columns, int rows,
                                                Glyphs glyphs);

}  // namespace darkling
