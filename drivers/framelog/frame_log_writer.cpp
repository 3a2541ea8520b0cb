// SPDX-License-Identifier: Apache-2.0
#include "drivers/framelog/frame_log_writer.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <type_traits>

#include <fcntl.h>
#include <lcm/eventlog.h>
#include <unistd.h>

#include "base/check.h"
#include "messages/channels.h"
#include "messages/checksum.h"
#include "messages/gap_t.hpp"
#include "messages/wire.h"

namespace darkling {

namespace {

constexpr std::int64_t kHeaderSize = 28;  // of an event, before its channel

void copy_pixels(const ImageView<const std::uint8_t>& image, std::vector<std::uint8_t>& pixels) {
  pixels.clear();
  for (int y = 0; y < image.height; ++y) {
    pixels.insert(pixels.end(), image.row(y), image.row(y) + image.width);
  }
}

std::int8_t fault_of(FrameFault fault) {
  switch (fault) {
    case FrameFault::kNone:
      break;
    case FrameFault::kUnreadable:
      return gap_t::FAULT_UNREADABLE;
    case FrameFault::kWrongSize:
      return gap_t::FAULT_WRONG_SIZE;
    case FrameFault::kUnpaired:
      return gap_t::FAULT_UNPAIRED;
  }
  return gap_t::FAULT_UNKNOWN;
}

}  // namespace

void FrameLogWriter::CloseLog::operator()(_lcm_eventlog_t* log) const {
  lcm_eventlog_destroy(log);
}

FrameLogWriter::FrameLogWriter(std::string path, _lcm_eventlog_t* log, std::int64_t max_bytes)
    : path_(std::move(path)), log_(log), max_bytes_(max_bytes) {}

Result<FrameLogWriter> FrameLogWriter::create(const std::string& path, const rig_t& rig,
                                              std::int64_t max_bytes) {
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "w");
  if (log == nullptr) {
    return failure(ExitCode::kUsage,
                   path + ": cannot be opened for writing: " + std::strerror(errno));
  }
  FrameLogWriter writer(path, log, max_bytes);
  // Without a buffer between: what a failure leaves in one would follow when the file is closed.
  std::setvbuf(log->f, nullptr, _IONBF, 0);
  ::fcntl(::fileno(log->f), F_SETFD, FD_CLOEXEC);
  rig_t record = rig;
  record.layout = rig_t::LAYOUT;
  if (auto added = writer.add_record(kRigChannel, record, FrameTime{}); !added) {
    return tl::unexpected(added.error());
  }
  return writer;
}

Result<void> FrameLogWriter::add_truth(const truth_t& truth) {
  CHECK(truth.count >= 0 && truth.keys.size() == static_cast<std::size_t>(truth.count) &&
            truth.poses.size() == truth.keys.size(),
        "a true trajectory has a key for every pose");
  return add_record(kTruthChannel, truth, FrameTime{});
}

Result<void> FrameLogWriter::add_frame(const StereoFrame& frame, std::int64_t utime_us) {
  CHECK(have_same_size(frame.left, frame.right) && !frame.left.is_empty(),
        "both eyes of a frame have the same size");
  frame_.seq = frame.sequence;
  frame_.stamp_ns = to_ns(frame.stamp);
  frame_.utime = utime_us;
  frame_.width = frame.left.width;
  frame_.height = frame.left.height;
  frame_.size = frame.left.width * frame.left.height;
  copy_pixels(frame.left, frame_.left);
  copy_pixels(frame.right, frame_.right);
  return add_record(kFrameChannel, frame_, frame.stamp);
}

Result<void> FrameLogWriter::add_gap(std::int64_t sequence, FrameTime stamp, FrameFault fault,
                                     std::int64_t utime_us) {
  gap_t gap = {};
  gap.seq = sequence;
  gap.stamp_ns = to_ns(stamp);
  gap.utime = utime_us;
  gap.fault = fault_of(fault);
  return add_record(kGapChannel, gap, stamp);
}

Result<void> FrameLogWriter::add_message(const char* channel, std::span<const std::byte> message,
                                         FrameTime stamp) {
  return write(channel, message, stamp);
}

template <class Message>
Result<void> FrameLogWriter::add_record(const char* channel, const Message& message,
                                        FrameTime stamp) {
  bytes_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  const std::size_t written = encode_into(bytes_, message);
  CHECK(written == bytes_.size(), "a message is as long as it says");
  if constexpr (std::is_same_v<Message, frame_t>) seal_frame_head(bytes_);
  seal_record(bytes_);
  return write(channel, bytes_, stamp);
}

Result<void> FrameLogWriter::write(const char* channel, std::span<const std::byte> bytes,
                                   FrameTime stamp) {
  if (error_) return tl::unexpected(*error_);
  const std::size_t channel_size = std::strlen(channel);
  const std::int64_t size = kHeaderSize + static_cast<std::int64_t>(channel_size + bytes.size());
  if (max_bytes_ > 0 && size_ + size > max_bytes_) {
    return fail("is full, " + std::to_string(max_bytes_) + " bytes are allowed");
  }
  // LCM counts its events' time in us, and asks for pointers to what it only reads.
  lcm_eventlog_event_t event = {.eventnum = 0,
                                .timestamp = to_ns(stamp) / 1000,
                                .channellen = static_cast<std::int32_t>(channel_size),
                                .datalen = static_cast<std::int32_t>(bytes.size()),
                                .channel = const_cast<char*>(channel),
                                .data = const_cast<std::byte*>(bytes.data())};
  if (lcm_eventlog_write_event(log_.get(), &event) != 0) return fail(std::strerror(errno));
  size_ += size;
  return {};
}

Result<void> FrameLogWriter::fail(const std::string& reason) {
  error_ = Error{ExitCode::kUsage, path_ + ": cannot be written any further: " + reason};
  // The part of a record that did get there goes. Where even that fails, readers see a torn end.
  (void)!::ftruncate(::fileno(log_->f), static_cast<off_t>(size_));
  return tl::unexpected(*error_);
}

Result<void> FrameLogWriter::close() {
  if (log_) {
    // liblcm closes without a word; what a network drive holds back would be lost unheard.
    if (!error_ && ::fsync(::fileno(log_->f)) != 0 && errno != EINVAL) {
      (void)fail(std::strerror(errno));
    }
    log_.reset();
  }
  if (error_) return tl::unexpected(*error_);
  return {};
}

}  // namespace darkling
