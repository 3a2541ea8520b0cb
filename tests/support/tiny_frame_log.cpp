// SPDX-License-Identifier: Apache-2.0
#include "support/tiny_frame_log.h"

#include <stdexcept>

#include "drivers/framelog/rig_record.h"

namespace darkling::test {

namespace {

void require(const Result<void>& done) {
  if (!done) throw std::runtime_error(done.error().message);
}

}  // namespace

StereoRig tiny_log_rig() {
  StereoRig rig;
  rig.left = {.width = kTinyWidth,
              .height = kTinyHeight,
              .fx = 100.1,
              .fy = 100.2,
              .cx = 2.5,
              .cy = 1.5,
              .distortion = Distortion::kRadTan,
              .coefficients = {-0.28, 0.07, 1e-4, 2e-5}};
  rig.right = rig.left;
  rig.right.fx = 1.0 / 3.0;
  Vector6 xi;
  xi << 0.1, -0.2, 0.3, 1.1, -0.7, 0.4;
  rig.T_body_rawleft = Se3::exp(xi);
  rig.T_body_rawright = rig.T_body_rawleft * Se3::exp(0.01 * xi);
  return rig;
}

truth_t tiny_truth() {
  truth_t truth = {};
  truth.frame = truth_t::FRAME_BODY;
  truth.key = truth_t::KEY_STAMP;
  truth.count = kTinyFrames;
  for (int k = 0; k < kTinyFrames; ++k) {
    truth.keys.push_back(to_ns(tiny_stamp(k)));
    truth.poses.push_back({1, 0, 0, 0.1 * k, 0, 1, 0, 0, 0, 0, 1, 0});
  }
  return truth;
}

std::uint8_t tiny_pixel(int frame, bool is_right, int x, int y) {
  return static_cast<std::uint8_t>(40 * frame + 7 * x + 31 * y + (is_right ? 128 : 0));
}

FrameTime tiny_stamp(int frame) {
  return FrameTime(std::chrono::seconds(1) + frame * std::chrono::milliseconds(50));
}

void add_tiny_frame(FrameLogWriter& writer, int frame) {
  constexpr int kStride = kTinyWidth + 5;
  std::vector<std::uint8_t> eyes[2];
  for (int eye = 0; eye < 2; ++eye) {
    eyes[eye].assign(kStride * kTinyHeight, 99);  // the padding is not to be written
    for (int y = 0; y < kTinyHeight; ++y) {
      for (int x = 0; x < kTinyWidth; ++x) {
        eyes[eye][y * kStride + x] = tiny_pixel(frame, eye == 1, x, y);
      }
    }
  }
  require(writer.add_frame({.sequence = 2 * frame,
                            .stamp = tiny_stamp(frame),
                            .left = {eyes[0].data(), kTinyWidth, kTinyHeight, kStride},
                            .right = {eyes[1].data(), kTinyWidth, kTinyHeight, kStride}},
                           to_ns(tiny_stamp(frame)) / 1000));
}

void write_tiny_frame_log(const std::string& path) {
  rig_t rig = to_rig_record(tiny_log_rig());
  rig.source = "tiny";
  rig.config = "width_px: 6\n";
  rig.version = "0";
  auto writer = FrameLogWriter::create(path, rig);
  if (!writer) throw std::runtime_error(writer.error().message);
  require(writer->add_truth(tiny_truth()));
  add_tiny_frame(*writer, 0);
  add_tiny_frame(*writer, 1);
  require(writer->add_gap(3, tiny_stamp(1) + std::chrono::milliseconds(25), FrameFault::kUnpaired));
  add_tiny_frame(*writer, 2);
  add_tiny_frame(*writer, 3);
  require(writer->close());
}

std::vector<std::size_t> event_starts(const std::string& log) {
  std::vector<std::size_t> starts;
  const std::string mark = "\xed\xa1\xda\x01";
  for (std::size_t at = log.find(mark); at != std::string::npos; at = log.find(mark, at + 1)) {
    starts.push_back(at);
  }
  starts.push_back(log.size());
  return starts;
}

}  // namespace darkling::test
