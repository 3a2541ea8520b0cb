// SPDX-License-Identifier: Apache-2.0
#include "vo/measure_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace darkling {

namespace {

constexpr int kStep = 3;  // px, from sample to sample, either way
constexpr double kMaskDeviation = 6.0;
// Of a normal distribution of deviation 1, a quarter lies closer to its middle than this.
constexpr double kFirstQuartile = 0.3186;
constexpr int kMaxResponse = 1023;  // that of half a black and half a white image is more

// The blur before comparing leaves 0.375 of white noise, and a comparison with a neighbour sees
// 0.8 (beside) to 1.05 (across) of that: 1.5 times 0.375 is 1.4 to 1.9 standard deviations of a
// difference. Tried at 0.5, 0.75, 1, 1.5 and twice, on photon noise of 60 to 5 electrons a pixel:
// up to 0.75 noise still makes bits, and in rendered drives nearly every frame became a keyframe;
// at 1.5 as few do as without noise and errors are least, clean images included; a zone of twice
// that and more thins weak texture (mine: drift 5 % instead of 0.4).
constexpr double kZonePerNoise = 1.5 * 0.375;
constexpr int kMaxZone = 64;

// Black levels of sensors lie below this; a scene that is seen at all has pixels above.
constexpr int kDarkLevel = 12;
constexpr int kBrightLevel = 250;

constexpr std::uint64_t kHashStart = 0xcbf29ce484222325;  // FNV-1a
constexpr std::uint64_t kHashFactor = 0x100000001b3;

// Of mean square differences: less than so many times what noise explains says nothing.
constexpr double kLeastOverNoise = 4.0;
constexpr int kFar = 4;  // px

using Histogram = std::array<int, kMaxResponse + 1>;

// Sums of squared differences along one axis.
struct Differences {
  std::int64_t near = 0;
  std::int64_t far = 0;
};

// Of `count` pixels and those beside and beyond.
void add_differences(const std::uint8_t* here, const std::uint8_t* beside,
                     const std::uint8_t* beyond, int count, Differences& sums) {
  int near = 0;
  int far = 0;
  for (int i = 0; i < count; ++i) {
    near += (beside[i] - here[i]) * (beside[i] - here[i]);
    far += (beyond[i] - here[i]) * (beyond[i] - here[i]);
  }
  sums.near += near;
  sums.far += far;
}

double sharpness_of(const Differences& differences, double by_noise) {
  const auto far = static_cast<double>(differences.far);
  if (far <= kLeastOverNoise * by_noise || differences.far == 0) return 0.0;
  return std::max(0.0, static_cast<double>(differences.near) - by_noise) / (far - by_noise);
}

int respond(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below) {
  const int corners = above[-1] + above[1] + below[-1] + below[1];
  const int sides = above[0] + here[-1] + here[1] + below[0];
  return corners - 2 * sides + 4 * here[0];
}

// From responses to the mask.
double noise_of(const Histogram& histogram, int count) {
  // Within the bin of the quartile, as if its responses were spread evenly: |r| = 0 stands for half
  // as wide a range as the others.
  const double wanted = 0.25 * count;
  int bin = 0;
  double below = 0.0;
  while (below + histogram[static_cast<std::size_t>(bin)] < wanted) {
    below += histogram[static_cast<std::size_t>(bin++)];
  }
  const double share = (wanted - below) / histogram[static_cast<std::size_t>(bin)];
  const double quartile = bin == 0 ? 0.5 * share : bin - 0.5 + share;
  return quartile / (kFirstQuartile * kMaskDeviation);
}

}  // namespace

ImageMeasure measure_image(const ImageView<const std::uint8_t>& grey) {
  Histogram histogram = {};
  int count = 0;
  int dark = 0;
  int bright = 0;
  std::array<ImageBand, kBandCount> bands = {};
  std::array<int, kBandCount> balance = {};  // pixels with a response less those without
  for (ImageBand& band : bands) band.hash = kHashStart;
  for (int y = 1; y + 1 < grey.height; y += kStep) {
    const auto b = static_cast<std::size_t>(y * kBandCount / grey.height);
    std::uint64_t hash = bands[b].hash;
    const std::uint8_t* above = grey.row(y - 1);
    const std::uint8_t* here = grey.row(y);
    const std::uint8_t* below = grey.row(y + 1);
    for (int x = 1; x + 1 < grey.width; x += kStep) {
      const int response = std::abs(respond(above + x, here + x, below + x));
      ++histogram[static_cast<std::size_t>(std::min(response, kMaxResponse))];
      ++count;
      dark += here[x] < kDarkLevel ? 1 : 0;
      bright += here[x] >= kBrightLevel ? 1 : 0;
      hash = (hash ^ here[x]) * kHashFactor;
      balance[b] += response != 0 ? 1 : -1;
    }
    bands[b].hash = hash;
  }
  for (std::size_t b = 0; b < bands.size(); ++b) bands[b].is_plain = balance[b] <= 0;
  if (count == 0) return {};
  return {.noise = noise_of(histogram, count),
          .dark_share = static_cast<double>(dark) / count,
          .bright_share = static_cast<double>(bright) / count,
          .bands = bands};
}

Sharpness measure_sharpness(const ImageView<const std::uint8_t>& grey, double noise) {
  Differences along_x;
  Differences along_y;
  const int width = grey.width - kFar;
  const int height = grey.height - kFar;
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* here = grey.row(y);
    add_differences(here, here + 1, here + kFar, width, along_x);
    add_differences(here, grey.row(y + 1), grey.row(y + kFar), width, along_y);
  }
  const double by_noise = 2.0 * noise * noise * width * height;
  return {sharpness_of(along_x, by_noise), sharpness_of(along_y, by_noise)};
}

Repetition repetition_of(const ImageMeasure& image, const ImageMeasure& other) {
  int repeated = 0;
  bool is_partial = false;
  for (std::size_t b = 0; b < image.bands.size(); ++b) {
    if (image.bands[b].hash != other.bands[b].hash) continue;
    ++repeated;
    is_partial |= !image.bands[b].is_plain;
  }
  const bool is_whole = repeated == kBandCount;
  return {.is_whole = is_whole, .is_partial = is_partial && !is_whole};
}

int dead_zone_of(double noise) {
  return std::min(static_cast<int>(std::lround(kZonePerNoise * noise)), kMaxZone);
}

}  // namespace darkling
