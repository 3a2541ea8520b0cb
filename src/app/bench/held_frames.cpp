// SPDX-License-Identifier: Apache-2.0
#include "app/bench/held_frames.h"

#include <algorithm>

namespace darkling {

namespace {

// The address of a vector's pixels stays when the vector itself moves.
ImageView<const std::uint8_t> hold(const ImageView<const std::uint8_t>& image,
                                   std::vector<std::vector<std::uint8_t>>& pixels) {
  std::vector<std::uint8_t>& held = pixels.emplace_back();
  held.reserve(static_cast<std::size_t>(image.width) * image.height);
  for (int y = 0; y < image.height; ++y) {
    held.insert(held.end(), image.row(y), image.row(y) + image.width);
  }
  return {held.data(), image.width, image.height, image.width};
}

}  // namespace

Result<HeldFrames> hold_frames(
    const std::string& source, const OpenOptions& options,
    const std::function<void(std::int64_t done, std::int64_t count)>& show) {
  auto recording = open_source(source, options);
  if (!recording) return tl::unexpected(recording.error());
  if (auto started = recording->source->start(); !started) {
    return tl::unexpected(started.error());
  }
  HeldFrames held;
  held.source = source;
  held.rig = recording->rig;
  for (;;) {
    const WaitResult next = recording->source->wait_next(std::chrono::seconds(1));
    if (next.status == WaitStatus::kTimeout || next.status == WaitStatus::kBadFrame) continue;
    if (next.status != WaitStatus::kFrame) break;
    StereoFrame frame = next.lease.frame();
    frame.left = hold(frame.left, held.pixels);
    frame.right = hold(frame.right, held.pixels);
    held.frames.push_back(frame);
    show(static_cast<std::int64_t>(held.frames.size()), recording->frame_count);
  }
  if (!held.frames.empty()) return held;
  return failure(ExitCode::kBadInput, source + ": holds no pair of images to play");
}

}  // namespace darkling
