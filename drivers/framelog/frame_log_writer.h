// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/stereo_frame.h"
#include "drivers/frame_source.h"
#include "messages/frame_t.hpp"
#include "messages/rig_t.hpp"
#include "messages/truth_t.hpp"

struct _lcm_eventlog_t;  // NOLINT(readability-identifier-naming): a name of LCM

namespace darkling {

// Writes a frame log, record by record: each has left the process when its call returns, and what
// was written before a failure stays a whole log. Records are stamped with the time of their frames
// and never with the wall clock's: the same frames give the same bytes.
// Memory: reused from the second frame on. Thread: one.
class FrameLogWriter {
 public:
  // Creates or empties `path` and writes the rig as the first record; its layout and checksum are
  // filled in.
  // @param max_bytes  of the file; 0: as the disk allows.
  // @return kUsage with the system's reason.
  [[nodiscard]] static Result<FrameLogWriter> create(const std::string& path, const rig_t& rig,
                                                     std::int64_t max_bytes = 0);

  // Each returns kUsage when the record cannot be written (the disk is full, `max_bytes` would be
  // passed); from then on nothing is written and each call returns the same.

  // At most once, before the first frame. @pre count, keys and poses agree.
  Result<void> add_truth(const truth_t& truth);
  // @param utime_us  of the frame's stamp, since 1970; 0: not known.
  // @pre both eyes have the same size.
  Result<void> add_frame(const StereoFrame& frame, std::int64_t utime_us = 0);
  // A pair that is missing, as its source reported it.
  Result<void> add_gap(std::int64_t sequence, FrameTime stamp, FrameFault fault,
                       std::int64_t utime_us = 0);
  // Anything else that arrived in between, encoded, under its own channel.
  Result<void> add_message(const char* channel, std::span<const std::byte> message,
                           FrameTime stamp);
  Result<void> close();

  [[nodiscard]] std::int64_t byte_count() const { return size_; }  // of whole records

 private:
  struct CloseLog {
    void operator()(_lcm_eventlog_t* log) const;
  };

  FrameLogWriter(std::string path, _lcm_eventlog_t* log, std::int64_t max_bytes);
  template <class Message>
  Result<void> add_record(const char* channel, const Message& message, FrameTime stamp);
  Result<void> write(const char* channel, std::span<const std::byte> bytes, FrameTime stamp);
  Result<void> fail(const std::string& reason);

  std::string path_;
  std::unique_ptr<_lcm_eventlog_t, CloseLog> log_;
  std::int64_t max_bytes_;
  std::int64_t size_ = 0;
  std::optional<Error> error_;
  frame_t frame_ = {};
  std::vector<std::byte> bytes_;  // of one record
};

}  // namespace darkling
