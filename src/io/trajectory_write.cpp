// SPDX-License-Identifier: Apache-2.0
#include <charconv>

#include "base/check.h"
#include "io/decimal_time.h"
#include "io/trajectory.h"

namespace darkling {

namespace {

// 17 significant digits: the same double comes back from every correct reader.
void append_number(std::string& line, double value) {
  constexpr int kDigitsAfterPoint = 16;
  char text[32];
  const double unsigned_zero = value + 0.0;  // -0 and 0 are the same place
  const auto written = std::to_chars(text, text + sizeof(text), unsigned_zero,
                                     std::chars_format::scientific, kDigitsAfterPoint);
  CHECK(written.ec == std::errc(), "a double of 17 digits fits into 32 characters");
  line.append(text, written.ptr);
}

}  // namespace

std::string format_kitti_row(const Se3& T_world_left) {
  const Matrix3 R = T_world_left.R();
  std::string line;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      append_number(line, R(row, column));
      line += ' ';
    }
    append_number(line, T_world_left.translation()[row]);
    line += row < 2 ? ' ' : '\n';
  }
  return line;
}

std::string format_tum_row(FrameTime stamp, const Se3& T_world_body) {
  const Vector3& t = T_world_body.translation();
  Eigen::Vector4d q = T_world_body.rotation().coeffs();  // x y z w
  if (q.w() < 0.0) q = -q;                               // one of the two names of a rotation
  std::string line = seconds_text_from_ns(to_ns(stamp));
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    line += ' ';
    append_number(line, value);
  }
  return line + '\n';
}

}  // namespace darkling
