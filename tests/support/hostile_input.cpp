// SPDX-License-Identifier: Apache-2.0
#include "support/hostile_input.h"

#include <stdexcept>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "drivers/framelog/framelog_source.h"
#include "support/message_cases.h"

namespace darkling::test {

namespace {

void require(bool holds, const char* rule) {
  if (!holds) throw std::logic_error(rule);
}

// A file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::byte> bytes) : descriptor_(::memfd_create("log", 0)) {
    require(descriptor_ >= 0, "a file in memory can be made");
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    require(written == static_cast<ssize_t>(bytes.size()), "and written");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

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
