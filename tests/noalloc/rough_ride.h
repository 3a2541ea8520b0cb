// SPDX-License-Identifier: Apache-2.0
// A thousand frames in which everything happens that can happen to the odometry.
#pragma once

#include <vector>

#include "support/synthetic_run.h"
#include "vo/odometry.h"

namespace darkling::test {

// What the odometry said on the way.
struct RideCounts {
  int frames = 0;
  int valid = 0;
  int lost = 0;
  int keyframes = 0;
  int resets = 0;
  int skipped = 0;
  int refinements = 0;  // applied
  int recoveries = 0;   // valid straight after lost, without a reset between
};

// Drives back and forth in one place, loses pairs, goes through darkness and noise, wakes up in
// another place, and comes back: in rounds of 250 frames. All frames are rendered beforehand.
class RoughRide {
 public:
  static constexpr int kFrames = 1000;
  static constexpr int kWidth_px = 96;

  RoughRide()
      : here_(synthetic_run("corridor,frames=24,width=96,seed=2")),
        elsewhere_(synthetic_run("quarry,frames=24,width=96,seed=3")),
        dark_(flat_frame(here_.frames[0], 0)) {
    for (unsigned seed = 0; seed < 4; ++seed) {
      noise_.push_back(noise_frame(here_.frames[0], seed));
    }
  }

  [[nodiscard]] const StereoRig& rig() const { return here_.rig; }

  // Uses no heap itself.
  [[nodiscard]] RideCounts drive(Odometry& odometry) const {
    RideCounts counts;
    TrackStatus before = TrackStatus::kUnknown;
    for (int i = 0; i < kFrames; ++i) {
      const KeptFrame* frame = at(i);
      const Estimate estimate = frame == nullptr ? odometry.skip(i, FrameTime(), kReasonDropped)
                                                 : odometry.track(frame->at(i));
      const bool is_valid = estimate.status == TrackStatus::kValid;
      const bool is_reset = estimate.reset_counter > counts.resets;
      ++counts.frames;
      if (frame == nullptr) ++counts.skipped;
      if (is_valid) ++counts.valid;
      if (frame != nullptr && estimate.status == TrackStatus::kLost) ++counts.lost;
      if (estimate.is_keyframe) ++counts.keyframes;
      if (estimate.refinement == Refinement::kApplied) ++counts.refinements;
      if (is_valid && before == TrackStatus::kLost && !is_reset) ++counts.recoveries;
      counts.resets = estimate.reset_counter;
      before = estimate.status;
    }
    return counts;
  }

 private:
  // To the end of a run and back again.
  static const KeptFrame* to_and_fro(const SyntheticRun& run, int i) {
    const int count = static_cast<int>(run.frames.size());
    const int step = i % (2 * count - 2);
    return &run.frames[step < count ? step : 2 * count - 2 - step];
  }

  // The frame that comes i-th; null where a pair is missing.
  [[nodiscard]] const KeptFrame* at(int i) const {
    const int in_round = i % 250;
    if (in_round >= 100 && in_round < 103) return nullptr;
    if (in_round >= 120 && in_round < 126) return &dark_;
    if (in_round >= 150 && in_round < 156) return &noise_[in_round % noise_.size()];
    return to_and_fro(in_round < 180 ? here_ : elsewhere_, i);
  }

  const SyntheticRun& here_;
  const SyntheticRun& elsewhere_;
  KeptFrame dark_;
  std::vector<KeptFrame> noise_;
};

}  // namespace darkling::test
