// SPDX-License-Identifier: Apache-2.0
#include "support/jpeg_images.h"

#include <cmath>
#include <stdexcept>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace darkling::test {

std::vector<std::uint8_t> jpeg_image(int width, int height, const JpegKind& kind) {
  cv::Mat image(height, width, kind.is_colour ? CV_8UC3 : CV_8UC1);
  const int channels = image.channels();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width * channels; ++x) {
      const double phase = kind.seed + 0.9 * (x % channels);
      const double wave = std::sin(0.31 * (x / channels) + phase) * std::cos(0.23 * y - phase);
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(128.0 + 100.0 * wave);
    }
  }
  std::vector<std::uint8_t> jpeg;
  const bool is_written = cv::imencode(
      ".jpg", image, jpeg,
      {cv::IMWRITE_JPEG_QUALITY, kind.quality, cv::IMWRITE_JPEG_PROGRESSIVE,
       kind.is_progressive ? 1 : 0, cv::IMWRITE_JPEG_OPTIMIZE, kind.has_best_tables ? 1 : 0});
  if (!is_written) throw std::runtime_error("OpenCV writes no JPEG");
  return jpeg;
}

std::vector<std::uint8_t> without_segments(const std::vector<std::uint8_t>& jpeg, int marker) {
  std::vector<std::uint8_t> rest(jpeg.begin(), jpeg.begin() + 2);
  std::size_t at = 2;
  while (jpeg.at(at + 1) != 0xDA) {  // the scan, behind which all is pixels
    const std::size_t size = 2 + (std::size_t{jpeg.at(at + 2)} << 8 | jpeg.at(at + 3));
    const auto first = jpeg.begin() + static_cast<std::ptrdiff_t>(at);
    if (jpeg[at + 1] != marker) {
      rest.insert(rest.end(), first, first + static_cast<std::ptrdiff_t>(size));
    }
    at += size;
  }
  rest.insert(rest.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(at), jpeg.end());
  return rest;
}

}  // namespace darkling::test
