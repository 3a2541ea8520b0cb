// SPDX-License-Identifier: Apache-2.0
#include "support/hostile_input.h"

#include <array>

#include "drivers/camera/jpeg_luma.h"
#include "drivers/framelog/framelog_source.h"
#include "support/memory_file.h"
#include "support/message_cases.h"
#include "support/require.h"

namespace darkling::test {

namespace {

template <class Message>
bool is_decoded_as(std::span<const std::byte> bytes) {
  Message message = {};
  if (!decode_from(bytes, message)) return false;
  require(encoded(message).size() == bytes.size(), "it is whole");
  return true;
}

unsigned sum_of(const ImageView<const std::uint8_t>& image) {
  unsigned sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y);
  }
  return sum;
}

}  // namespace

int decode_anything(std::span<const std::byte> bytes) {
  int types = 0;
  for_each_message(
      [&](const auto& m) { types += is_decoded_as<std::decay_t<decltype(m)>>(bytes) ? 1 : 0; });
  return types;
}

bool decode_any_jpeg(std::span<const std::byte> bytes) {
  constexpr int kWidth = 32;
  constexpr int kHeight = 16;
  static JpegLuma luma(kWidth);
  std::array<std::uint8_t, kWidth* kHeight> pixels = {};
  return luma.decode({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                     {pixels.data(), kWidth, kHeight, kWidth});
}

std::int64_t play_anything(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  auto log = open_frame_log(file.path());
  if (!log) {
    require(!log.error().message.empty(), "a refusal has a reason");
    return 0;
  }
  const auto row_count = static_cast<std::int64_t>(log->rows.size());
  const int width = log->rig.left.width;
  FramelogSource source(std::move(log->events), std::move(log->rows));
  require(source.start().has_value(), "what was opened can be started");
  std::int64_t last = -1;
  volatile unsigned sum = 0;
  for (WaitResult next = source.wait_next({}); next.status != WaitStatus::kEndOfSource;
       next = source.wait_next({})) {
    const bool is_frame = next.status == WaitStatus::kFrame;
    const std::int64_t sequence = is_frame ? next.lease.frame().sequence : next.sequence;
    require(sequence > last, "rows are numbered upwards");
    last = sequence;
    if (!is_frame) continue;
    require(next.lease.frame().left.width == width, "frames have the rig's size");
    sum = sum + sum_of(next.lease.frame().left) + sum_of(next.lease.frame().right);
  }
  const SourceStats stats = source.stats();
  require(stats.delivered + stats.unreadable + stats.wrong_size + stats.unpaired == row_count,
          "every row is told of once");
  return stats.delivered;
}

}  // namespace darkling::test
