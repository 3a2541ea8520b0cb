// SPDX-License-Identifier: Apache-2.0
#include "drivers/framelog/log_events.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "messages/big_endian.h"

namespace darkling {

static_assert(sizeof(off_t) == 8, "logs grow beyond 2 GiB; see CMakeLists.txt");

namespace {

// An event: mark, number (8), time stamp (8), length of the channel (4), length of the data (4),
// the channel, the data; big-endian.
constexpr std::array<std::byte, 4> kMark = {std::byte{0xed}, std::byte{0xa1}, std::byte{0xda},
                                            std::byte{0x01}};
constexpr std::size_t kHeaderSize = 28;
constexpr std::size_t kStampAt = 12;
constexpr std::size_t kChannelSizeAt = 20;
constexpr std::size_t kDataSizeAt = 24;

}  // namespace

Result<LogEvents> LogEvents::open(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    return failure(ExitCode::kNoInput, path + ": cannot be opened: " + std::strerror(errno));
  }
  struct stat about = {};
  const bool is_known = ::fstat(descriptor, &about) == 0;
  LogEvents events(path, descriptor, is_known ? std::int64_t{about.st_size} : 0);
  if (!is_known || !S_ISREG(about.st_mode)) {
    return failure(ExitCode::kBadInput, path + ": is not a file; a frame log is one");
  }
  if (events.size_ == 0) return failure(ExitCode::kNoInput, path + ": is empty");
  if (!events.has_mark(0)) {
    return failure(ExitCode::kBadInput,
                   path + ": is no frame log: LCM logs begin with ed a1 da 01");
  }
  return events;
}

LogEvents::~LogEvents() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void LogEvents::swap(LogEvents& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  std::swap(position_, other.position_);
  std::swap(damaged_bytes_, other.damaged_bytes_);
  std::swap(torn_bytes_, other.torn_bytes_);
  std::swap(channel_, other.channel_);
}

bool LogEvents::read_at(std::int64_t offset, std::span<std::byte> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const auto at = static_cast<off_t>(offset + static_cast<std::int64_t>(done));
    const ssize_t got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    done += static_cast<std::size_t>(got);
  }
  return true;
}

bool LogEvents::has_mark(std::int64_t at) const {
  std::array<std::byte, kMark.size()> found = {};
  return read_at(at, found) && found == kMark;
}

// @return where the file ends when there is none.
std::int64_t LogEvents::find_mark(std::int64_t from) const {
  constexpr std::int64_t kStep = std::int64_t{1} << 16;
  constexpr std::int64_t kOverlap = kMark.size() - 1;
  std::vector<std::byte> bytes(static_cast<std::size_t>(kStep + kOverlap));
  for (; from < size_; from += kStep) {
    const auto size = static_cast<std::size_t>(std::min(kStep + kOverlap, size_ - from));
    if (!read_at(from, std::span(bytes).first(size))) break;
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(size);
    const auto found = std::search(bytes.begin(), end, kMark.begin(), kMark.end());
    if (found != end) return from + (found - bytes.begin());
  }
  return size_;
}

std::optional<LogEvent> LogEvents::parse(std::int64_t at) {
  std::array<std::byte, kHeaderSize> header = {};
  if (!has_mark(at) || !read_at(at, header)) return std::nullopt;
  const auto channel_size = load_big_endian<std::int32_t>(header, kChannelSizeAt);
  const auto data_size = load_big_endian<std::int32_t>(header, kDataSizeAt);
  if (channel_size < 0 || channel_size > static_cast<std::int32_t>(kMaxChannel))
    return std::nullopt;
  const std::int64_t data_at = at + static_cast<std::int64_t>(kHeaderSize) + channel_size;
  if (data_size < 0 || data_at + data_size > size_) return std::nullopt;
  const auto size = static_cast<std::size_t>(channel_size);
  if (!read_at(at + static_cast<std::int64_t>(kHeaderSize),
               std::as_writable_bytes(std::span(channel_)).first(size))) {
    return std::nullopt;
  }
  return LogEvent{.timestamp_us = load_big_endian<std::int64_t>(header, kStampAt),
                  .channel = std::string_view(channel_, size),
                  .data_at = data_at,
                  .data_size = data_size};
}

std::optional<LogEvent> LogEvents::next() {
  while (position_ < size_) {
    const std::int64_t at = position_;
    const auto event = parse(at);
    if (!event) {
      position_ = find_mark(at + 1);
      (position_ == size_ ? torn_bytes_ : damaged_bytes_) += position_ - at;
      continue;
    }
    // Where no other event follows, the length may be what is wrong: look from the data on.
    const std::int64_t end = event->data_at + event->data_size;
    position_ = end == size_ || has_mark(end) ? end : find_mark(event->data_at);
    if (position_ == size_) torn_bytes_ += size_ - end;
    return event;
  }
  return std::nullopt;
}

}  // namespace darkling
