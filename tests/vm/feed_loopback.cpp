// SPDX-License-Identifier: Apache-2.0
// feed_loopback LEFT RIGHT WIDTHxHEIGHT RATE_HZ FILE [LOG]
//
// Plays the frames of dump_frames into two v4l2loopback devices until it is ended, forth and back
// and forth, so that the camera never jumps. LOG gets a line for every pair: when it was
// shown by CLOCK_MONOTONIC in ns, and which of the recording's pairs it was.
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "vm/loopback_device.h"

namespace darkling::test {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

std::int64_t now_ns() {
  timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kNsPerSecond + time.tv_nsec;
}

void sleep_until(std::int64_t time_ns) {
  const timespec time = {.tv_sec = time_ns / kNsPerSecond, .tv_nsec = time_ns % kNsPerSecond};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
}

// Which of `count` frames is shown at `step` when the end is turned at and not jumped from.
std::size_t forth_and_back(std::size_t step, std::size_t count) {
  if (count < 2) return 0;
  const std::size_t place = step % (2 * (count - 1));
  return place < count ? place : 2 * (count - 1) - place;
}

void feed(const std::vector<std::string>& words) {
  int width = 0;
  int height = 0;
  if (std::sscanf(words[2].c_str(), "%dx%d", &width, &height) != 2) {
    throw std::runtime_error("no size: " + words[2]);
  }
  const double period_s = 1.0 / std::stod(words[3]);
  const auto period_ns = static_cast<std::int64_t>(period_s * static_cast<double>(kNsPerSecond));
  std::ifstream file(words[4], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t count = bytes.size() / (2 * size);
  if (count == 0) throw std::runtime_error(words[4] + " holds no pair");
  const auto* const pixels = reinterpret_cast<const std::uint8_t*>(bytes.data());

  LoopbackDevice left(words[0], width, height);
  LoopbackDevice right(words[1], width, height);
  std::ofstream log;
  if (words.size() > 5) log.open(words[5]);
  std::int64_t due_ns = now_ns() + period_ns;
  for (std::size_t step = 0;; ++step, due_ns += period_ns) {
    sleep_until(due_ns);
    const std::size_t index = forth_and_back(step, count);
    if (log) log << now_ns() << ' ' << index << std::endl;
    left.show({pixels + 2 * index * size, size});
    right.show({pixels + (2 * index + 1) * size, size});
  }
}

}  // namespace
}  // namespace darkling::test

int main(int argc, char** argv) {
  if (argc < 6 || argc > 7) {
    std::fprintf(stderr, "feed_loopback LEFT RIGHT WIDTHxHEIGHT RATE_HZ FILE [LOG]\n");
    return 64;
  }
  try {
    darkling::test::feed({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "feed_loopback: %s\n", error.what());
  }
  return 70;
}
