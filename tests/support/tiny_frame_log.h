// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/framelog/frame_log_writer.h"
#include "geometry/stereo_rig.h"
#include "messages/truth_t.hpp"

namespace darkling::test {

// A log of a few frames of 6x4 px, whose pixels are told by tiny_pixel(). Frame k has sequence 2 k,
// stamp 1 s + 50 ms k; a gap (unpaired, sequence 3) lies between the second and the third frame.
inline constexpr int kTinyFrames = 4;
inline constexpr int kTinyWidth = 6;
inline constexpr int kTinyHeight = 4;

[[nodiscard]] StereoRig tiny_log_rig();
[[nodiscard]] truth_t tiny_truth();
[[nodiscard]] std::uint8_t tiny_pixel(int frame, bool is_right, int x, int y);
[[nodiscard]] FrameTime tiny_stamp(int frame);
void add_tiny_frame(FrameLogWriter& writer, int frame);
// Throws when it cannot be written.
void write_tiny_frame_log(const std::string& path);
// Where each of its records begins in the file, and the file's size: rig, truth, two frames, gap,
// two frames.
[[nodiscard]] std::vector<std::size_t> event_starts(const std::string& log);

}  // namespace darkling::test
