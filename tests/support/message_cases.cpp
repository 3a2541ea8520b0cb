// SPDX-License-Identifier: Apache-2.0
#include "support/message_cases.h"

#include <algorithm>

namespace darkling {

namespace {

constexpr std::int64_t kMax64 = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMin64 = std::numeric_limits<std::int64_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int8_t kMax8 = std::numeric_limits<std::int8_t>::max();
constexpr std::int8_t kMin8 = std::numeric_limits<std::int8_t>::min();

// The doubles that are easiest to lose on the way.
constexpr double kExtremes[] = {
    -0.0,
    std::numeric_limits<double>::max(),
    std::numeric_limits<double>::lowest(),
    std::numeric_limits<double>::denorm_min(),
    std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::quiet_NaN(),
    1.0 / 3.0,
};

void fill(double* numbers, int count) {
  for (int i = 0; i < count; ++i) numbers[i] = kExtremes[i % std::size(kExtremes)];
}

}  // namespace

update_t extreme_update() {
  update_t m = {};
  m.utime = kMax64;
  m.prev_utime = kMin64;
  m.mono_ns = kMin64;
  m.seq = kMax64;
  m.reset_counter = kMax32;
  m.status = kMax8;
  m.quality = kMin8;
  m.reasons = kMin32;
  fill(m.translation, 3);
  fill(m.rotation, 4);
  fill(m.covariance, 36);
  return m;
}

pose_t extreme_pose() {
  pose_t m = {};
  m.utime = kMin64;
  m.mono_ns = kMax64;
  m.seq = kMin64;
  m.reset_counter = kMin32;
  m.status = kMin8;
  m.quality = kMax8;
  fill(m.translation, 3);
  fill(m.rotation, 4);
  fill(m.velocity, 3);
  fill(m.angular_velocity, 3);
  fill(m.covariance, 36);
  return m;
}

status_t extreme_status() {
  status_t m = {};
  m.utime = kMax64;
  m.state = kMax8;
  m.reasons = kMin32;
  m.uptime_s = std::numeric_limits<double>::denorm_min();
  m.frames_in = kMax64;
  m.device_errors = kMin64;
  m.latency_max_ms = std::numeric_limits<double>::infinity();
  m.heap_calls = -1;
  m.is_recording = 1;
  m.width = kMax32;
  m.kernels = "";
  m.version = std::string(300, 'v');
  m.camera = "v4l2:/dev/video0,/dev/video1 \xc3\xa4";
  return m;
}

command_t extreme_command() {
  command_t m = {};
  m.utime = kMin64;
  m.command = kMax8;
  return m;
}

hint_t extreme_hint() {
  hint_t m = {};
  m.utime_from = kMin64;
  m.utime_to = kMax64;
  fill(m.translation, 3);
  fill(m.rotation, 4);
  m.valid_for_ms = kMin32;
  return m;
}

rig_t extreme_rig() {
  rig_t m = {};
  m.checksum = kMin64;
  m.layout = kMax32;
  m.model[1] = kMin8;
  m.width[0] = kMin32;
  m.height[1] = kMax32;
  fill(&m.intrinsics[0][0], 8);
  fill(&m.distortion[0][0], 8);
  fill(&m.translation[0][0], 6);
  fill(&m.rotation[0][0], 8);
  m.source = "";
  m.config = std::string(500, '#');
  m.version = "1";
  return m;
}

frame_t extreme_frame() {
  frame_t m = {};
  m.checksum = kMax64;
  m.head_checksum = kMin64;
  m.seq = kMax64;
  m.stamp_ns = kMin64;
  m.utime = kMax64;
  m.width = 3;
  m.height = 2;
  m.size = 6;
  m.left = {0, 1, 127, 128, 254, 255};
  m.right = {255, 254, 128, 127, 1, 0};
  return m;
}

gap_t extreme_gap() {
  gap_t m = {};
  m.checksum = kMin64;
  m.seq = kMin64;
  m.stamp_ns = kMax64;
  m.utime = kMin64;
  m.fault = kMin8;
  return m;
}

truth_t extreme_truth() {
  truth_t m = {};
  m.checksum = kMax64;
  m.frame = kMax8;
  m.key = kMin8;
  m.count = 2;
  m.keys = {kMin64, kMax64};
  m.poses.assign(2, std::vector<double>(12));
  for (std::vector<double>& pose : m.poses) fill(pose.data(), 12);
  return m;
}

}  // namespace darkling
