// SPDX-License-Identifier: Apache-2.0
#include "support/synthetic_run.h"

#include <algorithm>
#include <map>
#include <random>
#include <stdexcept>

#include "drivers/synthetic/synthetic_source.h"
#include "support/pixels.h"

namespace darkling::test {

namespace {

SyntheticRun render(const std::string& text) {
  const Result<SyntheticSpec> spec = parse_synthetic("synthetic:" + text);
  if (!spec) throw std::runtime_error(spec.error().message);
  const auto source = SyntheticSource::create(*spec);
  if (!source || !(*source)->start()) throw std::runtime_error("cannot render " + text);
  SyntheticRun run;
  run.rig = (*source)->rig();
  while (true) {
    const WaitResult next = (*source)->wait_next(Duration(0));
    if (next.status != WaitStatus::kFrame) break;
    const StereoFrame& frame = next.lease.frame();
    run.T_world_body.push_back((*source)->T_world_body(static_cast<int>(run.frames.size())));
    run.frames.push_back(
        {frame.left.width, frame.left.height, pixels_of(frame.left), pixels_of(frame.right)});
  }
  (*source)->stop();
  return run;
}

}  // namespace

StereoFrame KeptFrame::at(std::int64_t sequence) const {
  StereoFrame frame;
  frame.sequence = sequence;
  frame.stamp = frame_time_from_ns(1'000'000'000 + sequence * 50'000'000);
  frame.left = {left.data(), width, height, width};
  frame.right = {right.data(), width, height, width};
  return frame;
}

const SyntheticRun& synthetic_run(const std::string& text) {
  static std::map<std::string, SyntheticRun> runs;
  const auto found = runs.find(text);
  return found != runs.end() ? found->second : runs.emplace(text, render(text)).first->second;
}

KeptFrame flat_frame(const KeptFrame& like, std::uint8_t level) {
  KeptFrame frame = like;
  std::fill(frame.left.begin(), frame.left.end(), level);
  std::fill(frame.right.begin(), frame.right.end(), level);
  return frame;
}

KeptFrame noise_frame(const KeptFrame& like, unsigned seed) {
  KeptFrame frame = like;
  std::mt19937 random(seed);
  for (std::uint8_t& pixel : frame.left) pixel = static_cast<std::uint8_t>(random());
  for (std::uint8_t& pixel : frame.right) pixel = static_cast<std::uint8_t>(random());
  return frame;
}

}  // namespace darkling::test
