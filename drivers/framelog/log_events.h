// SPDX-License-Identifier: Apache-2.0
// The events of an LCM log file, read by ourselves. liblcm's reader is not used: it believes the
// lengths in the file (one flipped bit claims 2 GiB), calls the heap for every event, and does not
// say what it passed over. Writing is liblcm's; a test holds the two together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace darkling {

struct LogEvent {
  std::int64_t timestamp_us = 0;
  std::string_view channel;    // valid until the next call of next()
  std::int64_t data_at = 0;    // where its message begins, bytes from the start of the file
  std::int32_t data_size = 0;  // bytes; the file holds them
};

// An open log file and how far it was walked through. Move-only. Thread: one at a time; read_at()
// any.
class LogEvents {
 public:
  static constexpr std::size_t kMaxChannel = 63;  // LCM's own bound

  // @return kNoInput when it is absent, unreadable or empty; kBadInput when it is no file, or does
  //         not begin as an LCM log does.
  [[nodiscard]] static Result<LogEvents> open(const std::string& path);

  LogEvents(LogEvents&& other) noexcept : path_(std::move(other.path_)) { swap(other); }
  LogEvents& operator=(LogEvents&& other) noexcept {
    LogEvents(std::move(other)).swap(*this);
    return *this;
  }
  ~LogEvents();

  // The next whole event, or nothing at the end. What is damaged is passed over, up to the next
  // event's mark, and counted.
  [[nodiscard]] std::optional<LogEvent> next();
  // Fills `bytes` from `offset` on. @return false when the file does not hold them (any more).
  [[nodiscard]] bool read_at(std::int64_t offset, std::span<std::byte> bytes) const;

  [[nodiscard]] const std::string& path() const { return path_; }
  // Of no event, between events and behind the last: an event that was cut short.
  [[nodiscard]] std::int64_t damaged_bytes() const { return damaged_bytes_; }
  [[nodiscard]] std::int64_t torn_bytes() const { return torn_bytes_; }

 private:
  LogEvents(std::string path, int descriptor, std::int64_t size)
      : path_(std::move(path)), descriptor_(descriptor), size_(size) {}
  void swap(LogEvents& other) noexcept;
  [[nodiscard]] std::optional<LogEvent> parse(std::int64_t at);
  [[nodiscard]] bool has_mark(std::int64_t at) const;
  [[nodiscard]] std::int64_t find_mark(std::int64_t from) const;

  std::string path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
  std::int64_t position_ = 0;
  std::int64_t damaged_bytes_ = 0;
  std::int64_t torn_bytes_ = 0;
  char channel_[kMaxChannel] = {};
};

}  // namespace darkling
