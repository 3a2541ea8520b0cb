// SPDX-License-Identifier: Apache-2.0
#include "app/top/page.h"

#include <algorithm>

namespace darkling {

namespace {

constexpr const char* kHome = "\033[H";
constexpr const char* kEraseRestOfLine = "\033[0m\033[K";
constexpr const char* kEraseRestOfScreen = "\033[J";

// A byte that goes on with the character of the byte before.
bool is_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

const char* colour_of(Tone tone) {
  switch (tone) {
    case Tone::kGood:
      return "\033[32m";
    case Tone::kWarning:
      return "\033[33m";
    case Tone::kBad:
      return "\033[31m";
    case Tone::kFaint:
      return "\033[2m";
    case Tone::kPlain:
      break;
  }
  return "";
}

std::string painted(const Row& row) {
  std::string text;
  for (const Span& span : row) {
    text.append(colour_of(span.tone)).append(span.is_inverted ? "\033[7m" : "");
    text.append(span.text).append("\033[0m");
  }
  return text;
}

}  // namespace

int columns_of(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char byte) { return !is_continuation(byte); }));
}

int columns_of(const Row& row) {
  int columns = 0;
  for (const Span& span : row) columns += columns_of(span.text);
  return columns;
}

Row clip(const Row& row, int columns) {
  Row clipped;
  for (const Span& span : row) {
    std::size_t end = 0;
    while (end < span.text.size() && (columns > 0 || is_continuation(span.text[end]))) {
      columns -= is_continuation(span.text[end]) ? 0 : 1;
      ++end;
    }
    if (end > 0) clipped.push_back({span.text.substr(0, end), span.tone, span.is_inverted});
  }
  return clipped;
}

Row pad(Row row, int columns) {
  const int missing = columns - columns_of(row);
  if (missing > 0) row.push_back({std::string(static_cast<std::size_t>(missing), ' ')});
  return row;
}

std::string printable(std::string_view text) {
  std::string shown(text);
  std::replace_if(
      shown.begin(), shown.end(), [](char byte) { return byte < ' ' || byte > '~'; }, '?');
  return shown;
}

std::string plain_text(const Row& row) {
  std::string text;
  for (const Span& span : row) text += span.text;
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

std::string plain_text(const Page& page) {
  std::string text;
  for (const Row& row : page) text += plain_text(row) + '\n';
  return text;
}

std::string painted(const Page& page, int columns, int rows) {
  std::string text = kHome;
  const auto shown = std::min(page.size(), static_cast<std::size_t>(std::max(rows, 0)));
  for (std::size_t i = 0; i < shown; ++i) {
    text.append(i > 0 ? "\r\n" : "").append(painted(clip(page[i], columns)));
    // The last column filled, the cursor is still on it, and erasing would take its character.
    if (columns_of(page[i]) < columns) text.append(kEraseRestOfLine);
  }
  return text + kEraseRestOfScreen;
}

}  // namespace darkling
