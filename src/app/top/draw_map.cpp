// SPDX-License-Identifier: Apache-2.0
#include "app/top/draw_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/number_text.h"

namespace darkling {

namespace {

constexpr double kLeastSpan_m = 1.0;
constexpr double kRowsPerColumn = 0.5;  // a character is about twice as high as it is wide

// The patterns' bits, by dot from the left and from above (Unicode 15.0, block U+2800).
constexpr std::uint8_t kBrailleBits[2][4] = {{0x01, 0x02, 0x04, 0x40}, {0x08, 0x10, 0x20, 0x80}};

struct Box {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d most = Eigen::Vector2d::Constant(-1e300);
  void add(const Eigen::Vector2d& p) {
    least = least.cwiseMin(p);
    most = most.cwiseMax(p);
  }
};

// Right and up on the map, m.
Eigen::Vector2d to_map(const Vector3& p_world) {
  return {-p_world.y(), p_world.x()};
}

// Characters with dots in them. A place on it is (column, row) from the upper left.
class Canvas {
 public:
  Canvas(int columns, int rows, Glyphs glyphs)
      : columns_(columns),
        rows_(rows),
        glyphs_(glyphs),
        bits_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0),
        marks_(bits_.size()) {}

  void set(const Eigen::Vector2d& place) {
    const int x = static_cast<int>(std::floor(place.x() * 2.0));
    const int y = static_cast<int>(std::floor(place.y() * 4.0));
    if (x < 0 || y < 0 || x >= 2 * columns_ || y >= 4 * rows_) return;
    bits_[index(x / 2, y / 4)] |= kBrailleBits[x % 2][y % 4];
  }

  void connect(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector2d way = to - from;
    const int steps =
        1 + static_cast<int>(std::max(std::abs(way.x()) * 2.0, std::abs(way.y()) * 4.0));
    for (int i = 0; i <= steps; ++i) set(from + way * (static_cast<double>(i) / steps));
  }

  void mark(const Eigen::Vector2d& place, const char* ascii, const char* unicode) {
    const int x = static_cast<int>(std::floor(place.x()));
    const int y = static_cast<int>(std::floor(place.y()));
    if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return;
    marks_[index(x, y)] = glyphs_ == Glyphs::kUnicode ? unicode : ascii;
  }

  [[nodiscard]] std::string line(int row) const {
    std::string text;
    for (int column = 0; column < columns_; ++column) {
      const std::size_t i = index(column, row);
      text += !marks_[i].empty() ? marks_[i] : glyph(bits_[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  [[nodiscard]] std::string glyph(std::uint8_t bits) const {
    if (bits == 0) return " ";
    if (glyphs_ == Glyphs::kAscii) return ".";
    // U+2800 + bits in UTF-8.
    return {'\xe2', static_cast<char>(0xa0 | (bits >> 6)), static_cast<char>(0x80 | (bits & 0x3f))};
  }

  int columns_;
  int rows_;
  Glyphs glyphs_;
  std::vector<std::uint8_t> bits_;
  std::vector<std::string> marks_;
};

// The next larger of ten steps a decade, so that the map does not breathe with every frame.
double round_up(double m_per_column) {
  constexpr double kSteps = 10.0;
  return std::pow(10.0, std::ceil(kSteps * std::log10(m_per_column) - 1e-9) / kSteps);
}

// The largest of 1, 2, 5, 10, 20 … m that is at most `most_m`.
double bar_length_m(double most_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(most_m)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * decade <= most_m) return digit * decade;
  }
  return decade;
}

std::string draw_bar(double m_per_column, int columns, Glyphs glyphs) {
  const double length_m = bar_length_m(m_per_column * columns / 3.0);
  const int width = std::max(2, static_cast<int>(std::lround(length_m / m_per_column)));
  const bool is_unicode = glyphs == Glyphs::kUnicode;
  std::string bar = is_unicode ? "├" : "|";
  for (int i = 2; i < width; ++i) bar += is_unicode ? "─" : "-";
  return bar + (is_unicode ? "┤ " : "| ") + number_text(length_m) + " m, x up";
}

}  // namespace

std::vector<std::string> draw_map(const Track& track, int columns, int rows, Glyphs glyphs) {
  std::vector<std::string> lines(static_cast<std::size_t>(rows));
  if (track.points().empty()) {
    lines[0] = "no track yet";
    return lines;
  }
  Box box;
  for (const Track::Point& point : track.points()) box.add(to_map(point.position));
  box.add(to_map(track.here()));

  // One character at each edge stays free.
  const Eigen::Vector2d span_m = (box.most - box.least).cwiseMax(kLeastSpan_m);
  const int map_rows = rows - 1;
  const double m_per_column =
      round_up(std::max(span_m.x() / (columns - 2), span_m.y() * kRowsPerColumn / (map_rows - 1)));
  const Eigen::Vector2d centre = (box.least + box.most) / 2.0;
  const auto place_of = [&](const Vector3& position) -> Eigen::Vector2d {
    const Eigen::Vector2d offset = (to_map(position) - centre) / m_per_column;
    return {columns / 2.0 + offset.x(), map_rows / 2.0 - offset.y() * kRowsPerColumn};
  };

  Canvas canvas(columns, map_rows, glyphs);
  Eigen::Vector2d before = place_of(track.points().front().position);
  for (const Track::Point& point : track.points()) {
    const Eigen::Vector2d place = place_of(point.position);
    canvas.connect(point.is_start ? place : before, place);
    before = place;
  }
  canvas.mark(place_of(track.points().front().position), "o", "○");
  canvas.mark(place_of(track.here()), "@", "●");
  for (int row = 0; row < map_rows; ++row) lines[static_cast<std::size_t>(row)] = canvas.line(row);
  lines.back() = draw_bar(m_per_column, columns, glyphs);
  return lines;
}

}  // namespace darkling
