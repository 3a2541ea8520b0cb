// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "app/open_dataset.h"
#include "app/selected_frames.h"
#include "drivers/synthetic/synthetic_source.h"

namespace darkling {

namespace {

Trajectory exact_truth(const SyntheticSource& source) {
  Trajectory truth;
  truth.frame = PoseFrame::kBody;
  truth.key = PoseKey::kStamp;
  for (int k = 0; k < source.spec().frames; ++k) {
    truth.poses.push_back({source.stamp(k), to_affine(source.T_world_body(k))});
  }
  return truth;
}

}  // namespace

Result<Recording> open_synthetic(std::string_view text, const OpenOptions& options) {
  const auto spec = parse_synthetic(text);
  if (!spec) return tl::unexpected(spec.error());
  if (options.first >= spec->frames) {
    return failure(ExitCode::kUsage,
                   std::string(text) + ": frames from " + std::to_string(options.first) +
                       " on are asked for, it has frames 0 to " + std::to_string(spec->frames - 1));
  }
  auto source = SyntheticSource::create(*spec);
  if (!source) return tl::unexpected(source.error());
  Recording recording;
  recording.name = spec->scene;
  recording.kind = "synthetic";
  recording.rig = (*source)->rig();
  recording.truth = exact_truth(**source);
  const std::int64_t span = std::min<std::int64_t>(options.last, spec->frames) - options.first;
  recording.frame_count = (span + options.stride - 1) / options.stride;
  recording.source = std::make_unique<SelectedFrames>(std::move(*source), options);
  return recording;
}

}  // namespace darkling
