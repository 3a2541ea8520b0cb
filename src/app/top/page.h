// SPDX-License-Identifier: Apache-2.0
// Text for a terminal, before it is known whether that shows colours and how large it is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace darkling {

enum class Tone { kPlain = 0, kGood, kWarning, kBad, kFaint };

// A piece of a line in one tone. UTF-8 of characters that are one column wide, none of control.
struct Span {
  std::string text;
  Tone tone = Tone::kPlain;
  bool is_inverted = false;
};
using Row = std::vector<Span>;
using Page = std::vector<Row>;

// How many columns of a terminal `text` takes.
[[nodiscard]] int columns_of(std::string_view text);
[[nodiscard]] int columns_of(const Row& row);

// The first `columns` of them.
[[nodiscard]] Row clip(const Row& row, int columns);
// With spaces behind, so that it takes `columns` at least.
[[nodiscard]] Row pad(Row row, int columns);

// What the network said, fit for a terminal: all but printable ASCII becomes '?'.
[[nodiscard]] std::string printable(std::string_view text);

[[nodiscard]] std::string plain_text(const Row& row);
// Every row on a line of its own, without tones or spaces at the ends.
[[nodiscard]] std::string plain_text(const Page& page);
// What draws as much of the page as fits into the terminal, and clears the rest of it.
[[nodiscard]] std::string painted(const Page& page, int columns, int rows);

}  // namespace darkling
