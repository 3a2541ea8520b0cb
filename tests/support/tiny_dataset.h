// SPDX-License-Identifier: Apache-2.0
// Recordings of a few small frames, written where a test wants them and then spoilt by it.
//
// Both cameras look at a textured wall; every frame moves them by one pixel to the right, parallel
// to it. f = width, disparity 4 px, baseline 0.1 m; no distortion.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace darkling::test {

struct TinyDataset {
  int frames = 4;
  int width = 96;
  int height = 64;

  static constexpr double kBaseline_m = 0.1;
  static constexpr int kDisparity_px = 4;
  [[nodiscard]] double step_m() const { return kBaseline_m / kDisparity_px; }
};

// image_0 image_1 calib.txt times.txt poses.txt, 10 Hz.
void write_tiny_kitti(const std::string& folder, const TinyDataset& dataset = {});

// mav0/cam0 mav0/cam1 (data.csv, sensor.yaml, data/) and groundtruth.tum, 20 Hz. Body: x forward,
// y left, z up at the left camera.
void write_tiny_euroc(const std::string& folder, const TinyDataset& dataset = {});

// The names of the frame's files: "000003.png" and "1403636579913555456.png".
[[nodiscard]] std::string kitti_image_name(int frame);
[[nodiscard]] std::int64_t euroc_stamp_ns(int frame);
[[nodiscard]] std::string euroc_image_name(int frame);

// A camchain.yaml that says the same as the sensor.yaml files of write_tiny_euroc().
[[nodiscard]] std::string tiny_camchain(const TinyDataset& dataset = {});

struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // row by row, no padding
};

// What the left (right) camera sees in `frame`.
[[nodiscard]] GreyImage tiny_image(const TinyDataset& dataset, int frame, bool is_right);

// Written in the format that the suffix of `path` names. Both throw when they cannot.
void write_image(const std::string& path, const GreyImage& image);
// A 16-bit file: each pixel's grey level in the upper 8 bits, 0xff in the lower.
void write_image16(const std::string& path, const GreyImage& image);

}  // namespace darkling::test
