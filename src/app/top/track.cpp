// SPDX-License-Identifier: Apache-2.0
#include "app/top/track.h"

namespace darkling {

void Track::add(const Vector3& position, int reset_counter) {
  here_ = position;
  if (!counted_to_ || reset_counter != reset_counter_) {
    reset_counter_ = reset_counter;
    counted_to_ = position;
    points_.push_back({position, true});
  } else {
    const double step_m = (position - *counted_to_).norm();
    if (step_m < kLeastStep_m) return;
    distance_m_ += step_m;
    counted_to_ = position;
    if ((position - points_.back().position).norm() < spacing_m_) return;
    points_.push_back({position, false});
  }
  if (points_.size() >= kMaxPoints) thin_out();
}

// Every other point goes; a start is the start of those that stay.
void Track::thin_out() {
  std::size_t kept = 0;
  bool is_start_gone = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    is_start_gone = is_start_gone || points_[i].is_start;
    if (i % 2 == 1) continue;
    points_[kept++] = {points_[i].position, is_start_gone};
    is_start_gone = false;
  }
  points_.resize(kept);
  spacing_m_ *= 2.0;
}

}  // namespace darkling
