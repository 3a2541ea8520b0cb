// SPDX-License-Identifier: Apache-2.0
// dump_frames SOURCE FILE: writes all pairs of a recording or scene as raw grey pixels, left image,
// right image, left …, for feed_loopback; prints their size as "WIDTHxHEIGHT". On the host, so that
// the guest decodes nothing.
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "app/open_source.h"

namespace darkling {
namespace {

void write_image(std::ofstream& file, const ImageView<const std::uint8_t>& image) {
  for (int y = 0; y < image.height; ++y) {
    file.write(reinterpret_cast<const char*>(image.row(y)), image.width);
  }
}

void dump(const std::string& source_text, const std::string& path) {
  auto recording = open_source(source_text, {});
  if (!recording) throw std::runtime_error(recording.error().message);
  const auto started = recording->source->start();
  if (!started) throw std::runtime_error(started.error().message);

  std::ofstream file(path, std::ios::binary);
  std::string size;
  for (;;) {
    const WaitResult next = recording->source->wait_next(Duration::zero());
    if (next.status == WaitStatus::kEndOfSource) break;
    if (next.status != WaitStatus::kFrame) throw std::runtime_error("a pair cannot be read");
    const StereoFrame& frame = next.lease.frame();
    write_image(file, frame.left);
    write_image(file, frame.right);
    size = std::to_string(frame.left.width) + "x" + std::to_string(frame.left.height);
  }
  if (!file.flush()) throw std::runtime_error(path + " cannot be written");
  std::printf("%s\n", size.c_str());
}

}  // namespace
}  // namespace darkling

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "dump_frames SOURCE FILE\n");
    return 64;
  }
  try {
    darkling::dump(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dump_frames: %s\n", error.what());
    return 70;
  }
}
