// SPDX-License-Identifier: Apache-2.0
#include "support/tiny_dataset.h"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "support/temporary_folder.h"

namespace darkling::test {

namespace {

// A grey level in [0, 1] for a knot of the texture's grid, without pattern.
double knot(std::int64_t x, std::int64_t y) {
  std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u;
  h ^= static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  h ^= h >> 32;
  return static_cast<double>(h & 0xffffu) / 65535.0;
}

// Knots every 3 px, linear between.
std::uint8_t texture(double x, double y) {
  constexpr double kSpacing_px = 3.0;
  const double u = x / kSpacing_px;
  const double v = y / kSpacing_px;
  const auto i = static_cast<std::int64_t>(std::floor(u));
  const auto j = static_cast<std::int64_t>(std::floor(v));
  const double a = u - std::floor(u);
  const double b = v - std::floor(v);
  const double level = (1 - b) * ((1 - a) * knot(i, j) + a * knot(i + 1, j)) +
                       b * ((1 - a) * knot(i, j + 1) + a * knot(i + 1, j + 1));
  return static_cast<std::uint8_t>(20.0 + 215.0 * level);
}

std::string calib_line(const char* name, const TinyDataset& dataset, double t_px_m) {
  std::ostringstream line;
  const int f = dataset.width;
  line << name << ": " << f << " 0 " << (dataset.width - 1) * 0.5 << " " << t_px_m << " 0 " << f
       << " " << (dataset.height - 1) * 0.5 << " 0 0 0 1 0\n";
  return line.str();
}

std::string camera_keys(const TinyDataset& dataset, const std::string& indent) {
  std::ostringstream keys;
  keys << indent << "resolution: [" << dataset.width << ", " << dataset.height << "]\n"
       << indent << "camera_model: pinhole\n"
       << indent << "intrinsics: [" << dataset.width << ", " << dataset.width << ", "
       << (dataset.width - 1) * 0.5 << ", " << (dataset.height - 1) * 0.5 << "]\n";
  return keys.str();
}

std::string sensor_yaml(const TinyDataset& dataset, double y_body_m) {
  std::ostringstream yaml;
  yaml << "# General sensor definitions.\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n"
       << "  data: [0, 0, 1, 0,\n         -1, 0, 0, " << y_body_m
       << ",\n         0, -1, 0, 0,\n         0, 0, 0, 1]\nrate_hz: 20\n"
       << camera_keys(dataset, "") << "distortion_model: radial-tangential\n"
       << "distortion_coefficients: [0, 0, 0, 0]\n";
  return yaml.str();
}

void write_euroc_camera(const std::string& folder, const TinyDataset& dataset, bool is_right) {
  std::string csv = "#timestamp [ns],filename\n";
  for (int k = 0; k < dataset.frames; ++k) {
    csv += std::to_string(euroc_stamp_ns(k)) + "," + euroc_image_name(k) + "\n";
    write_image(folder + "/data/" + euroc_image_name(k), tiny_image(dataset, k, is_right));
  }
  write_text(folder + "/data.csv", csv);
  write_text(folder + "/sensor.yaml",
             sensor_yaml(dataset, is_right ? -TinyDataset::kBaseline_m : 0.0));
}

}  // namespace

std::string kitti_image_name(int frame) {
  const std::string number = std::to_string(frame);
  return std::string(6 - number.size(), '0') + number + ".png";
}

std::int64_t euroc_stamp_ns(int frame) {
  return 1403636579763555584 + frame * 50'000'000LL;
}

std::string euroc_image_name(int frame) {
  return std::to_string(euroc_stamp_ns(frame)) + ".png";
}

GreyImage tiny_image(const TinyDataset& dataset, int frame, bool is_right) {
  GreyImage image{dataset.width, dataset.height, {}};
  const int shift_px = frame + (is_right ? TinyDataset::kDisparity_px : 0);
  for (int y = 0; y < dataset.height; ++y) {
    for (int x = 0; x < dataset.width; ++x) image.pixels.push_back(texture(x + shift_px, y));
  }
  return image;
}

void write_tiny_kitti(const std::string& folder, const TinyDataset& dataset) {
  std::ostringstream times;
  std::ostringstream poses;
  for (int k = 0; k < dataset.frames; ++k) {
    times << k / 10 << "." << k % 10 << "\n";
    poses << "1 0 0 " << k * dataset.step_m() << " 0 1 0 0 0 0 1 0\n";
    write_image(folder + "/image_0/" + kitti_image_name(k), tiny_image(dataset, k, false));
    write_image(folder + "/image_1/" + kitti_image_name(k), tiny_image(dataset, k, true));
  }
  write_text(folder + "/times.txt", times.str());
  write_text(folder + "/poses.txt", poses.str());
  write_text(folder + "/calib.txt",
             calib_line("P0", dataset, 0.0) +
                 calib_line("P1", dataset, -dataset.width * TinyDataset::kBaseline_m));
}

void write_tiny_euroc(const std::string& folder, const TinyDataset& dataset) {
  write_euroc_camera(folder + "/mav0/cam0", dataset, false);
  write_euroc_camera(folder + "/mav0/cam1", dataset, true);
  std::ostringstream truth;
  truth << "# timestamp(s) tx ty tz qx qy qz qw\n";
  for (int k = 0; k < dataset.frames; ++k) {
    const std::string ns = std::to_string(euroc_stamp_ns(k));
    truth << ns.substr(0, ns.size() - 9) << "." << ns.substr(ns.size() - 9) << " 0 "
          << -k * dataset.step_m() << " 0 0 0 0 1\n";
  }
  write_text(folder + "/groundtruth.tum", truth.str());
}

std::string tiny_camchain(const TinyDataset& dataset) {
  const std::string lens = camera_keys(dataset, "  ") +
                           "  distortion_model: radtan\n  distortion_coeffs: [0, 0, 0, 0]\n";
  std::ostringstream chain;
  chain << "cam0:\n"
        << lens << "  T_cam_imu:\n  - [0, -1, 0, 0]\n  - [0, 0, -1, 0]\n  - [1, 0, 0, 0]\n"
        << "  - [0, 0, 0, 1]\n"
        << "cam1:\n"
        << lens << "  T_cn_cnm1:\n  - [1, 0, 0, " << -TinyDataset::kBaseline_m
        << "]\n  - [0, 1, 0, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n";
  return chain.str();
}

void write_image(const std::string& path, const GreyImage& image) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  cv::Mat pixels(image.height, image.width, CV_8UC1);
  std::copy(image.pixels.begin(), image.pixels.end(), pixels.begin<std::uint8_t>());
  if (!cv::imwrite(path, pixels)) throw std::runtime_error("cannot write " + path);
}

void write_image16(const std::string& path, const GreyImage& image) {
  cv::Mat pixels(image.height, image.width, CV_16UC1);
  std::transform(image.pixels.begin(), image.pixels.end(), pixels.begin<std::uint16_t>(),
                 [](std::uint8_t level) { return static_cast<std::uint16_t>(level << 8 | 0xff); });
  if (!cv::imwrite(path, pixels)) throw std::runtime_error("cannot write " + path);
}

}  // namespace darkling::test
