// SPDX-License-Identifier: Apache-2.0
#include "drivers/framelog/frame_log.h"

#include <array>

#include "drivers/framelog/rig_record.h"
#include "messages/big_endian.h"
#include "messages/channels.h"
#include "messages/checksum.h"
#include "messages/frame_t.hpp"
#include "messages/gap_t.hpp"
#include "messages/wire.h"

namespace darkling {

namespace {

constexpr std::int64_t kMaxSequence = std::int64_t{1} << 52;  // for arithmetic without overflow
constexpr Duration kMaxStamp{std::int64_t{1} << 61};
constexpr std::int32_t kMaxTextRecord = 64 << 20;  // bytes of a rig or truth; longer: damaged

FrameFault fault_of(std::int8_t fault) {
  switch (fault) {
    case gap_t::FAULT_WRONG_SIZE:
      return FrameFault::kWrongSize;
    case gap_t::FAULT_UNPAIRED:
      return FrameFault::kUnpaired;
    default:
      return FrameFault::kUnreadable;
  }
}

// Fills a FrameLog event by event.
class Listing {
 public:
  explicit Listing(LogEvents events) : log_{.events = std::move(events)} {}

  Result<FrameLog> finish() && {
    while (const auto event = log_.events.next()) add(*event);
    const std::string& path = log_.events.path();
    if (!has_rig_) {
      return failure(ExitCode::kBadInput,
                     path + (is_rig_damaged_ ? ": its rig is damaged, nothing can be played"
                                             : ": is an LCM log, but no frame log: it has no "
                                               "record on DARKLING_RIG"));
    }
    auto rig = from_rig_record(log_.record);
    if (!rig) return failure(rig.error().code, path + ": " + rig.error().message);
    log_.rig = *rig;
    for (FrameLogRow& row : log_.rows) check_size(row);
    return std::move(log_);
  }

 private:
  void add(const LogEvent& event) {
    if (event.channel == kFrameChannel) {
      add_frame(event);
    } else if (event.channel == kGapChannel) {
      add_gap(event);
    } else if (event.channel == kRigChannel && !has_rig_) {
      has_rig_ = read_whole(event, log_.record);
      is_rig_damaged_ = !has_rig_;
    } else if (event.channel == kTruthChannel && !log_.truth) {
      truth_t truth;
      if (read_whole(event, truth)) {
        log_.truth = std::move(truth);
      } else {
        ++log_.damaged_records;
      }
    } else if (event.channel == kCommandChannel) {
      add_message(event, kCommandChannel);
    } else if (event.channel == kHintChannel) {
      add_message(event, kHintChannel);
    } else {
      ++log_.other_records;
    }
  }

  template <class Message>
  bool read_whole(const LogEvent& event, Message& message) {
    if (event.data_size > kMaxTextRecord) return false;
    bytes_.resize(static_cast<std::size_t>(event.data_size));
    return log_.events.read_at(event.data_at, bytes_) && is_record_sound(bytes_) &&
           decode_from(bytes_, message);
  }

  void add_frame(const LogEvent& event) {
    std::array<std::byte, kFrameHeadEnd> head = {};
    if (event.data_size < static_cast<std::int32_t>(head.size()) ||
        !log_.events.read_at(event.data_at, head) ||
        load_big_endian<std::int64_t>(head, 0) != frame_t::getHash() ||
        !is_frame_head_sound(head)) {
      return add_damaged(event);
    }
    const auto width = load_big_endian<std::int32_t>(head, 48);
    const auto height = load_big_endian<std::int32_t>(head, 52);
    const auto size = load_big_endian<std::int32_t>(head, 56);
    const bool has_size = width > 0 && height > 0 && std::int64_t{width} * height == size &&
                          std::int64_t{kFrameHeadEnd} + 2 * std::int64_t{size} == event.data_size;
    add_row({.sequence = load_big_endian<std::int64_t>(head, 24),
             .stamp = frame_time_from_ns(load_big_endian<std::int64_t>(head, 32)),
             .fault = has_size ? FrameFault::kNone : FrameFault::kUnreadable,
             .data_at = event.data_at,
             .width = width,
             .height = height});
  }

  void add_gap(const LogEvent& event) {
    gap_t gap;
    if (!read_whole(event, gap)) return add_damaged(event);
    add_row({.sequence = gap.seq,
             .stamp = frame_time_from_ns(gap.stamp_ns),
             .fault = fault_of(gap.fault),
             .data_at = event.data_at,
             .width = 0,
             .height = 0});
  }

  void add_message(const LogEvent& event, const char* channel) {
    log_.messages.push_back({.channel = channel,
                             .row = rows().size(),
                             .data_at = event.data_at,
                             .data_size = event.data_size});
  }

  // A row of which only its place is known.
  void add_damaged(const LogEvent& event) {
    const bool has_stamp =
        event.timestamp_us >= 0 && event.timestamp_us <= kMaxStamp.count() / 1000;
    rows().push_back({.sequence = rows().empty() ? 0 : rows().back().sequence + 1,
                      .stamp = frame_time_from_ns(has_stamp ? event.timestamp_us * 1000 : 0),
                      .fault = FrameFault::kUnreadable,
                      .data_at = kUnknownPlace,
                      .width = 0,
                      .height = 0});
  }

  void add_row(const FrameLogRow& row) {
    // Guessed numbers give way to known ones.
    while (!rows().empty() && rows().back().data_at == kUnknownPlace &&
           rows().back().sequence >= row.sequence) {
      rows().pop_back();
      ++log_.damaged_records;
    }
    for (auto m = log_.messages.rbegin(); m != log_.messages.rend() && m->row > rows().size();
         ++m) {
      m->row = rows().size();
    }
    const bool grows = rows().empty() || row.sequence > rows().back().sequence;
    const bool is_possible = row.sequence >= 0 && row.sequence <= kMaxSequence &&
                             abs(row.stamp.time_since_epoch()) <= kMaxStamp;
    if (!is_possible || !grows) {
      ++log_.damaged_records;
      return;
    }
    rows().push_back(row);
  }

  void check_size(FrameLogRow& row) const {
    const bool has_size = row.width == log_.rig.left.width && row.height == log_.rig.left.height;
    if (row.fault == FrameFault::kNone && !has_size) row.fault = FrameFault::kWrongSize;
  }

  std::vector<FrameLogRow>& rows() { return log_.rows; }

  static constexpr std::int64_t kUnknownPlace = -1;

  FrameLog log_;
  bool has_rig_ = false;
  bool is_rig_damaged_ = false;
  std::vector<std::byte> bytes_;
};

}  // namespace

Result<FrameLog> open_frame_log(const std::string& path) {
  auto events = LogEvents::open(path);
  if (!events) return tl::unexpected(events.error());
  return Listing(std::move(*events)).finish();
}

std::string describe_damage(const FrameLog& log) {
  std::string text;
  const auto add = [&](std::int64_t count, const char* what) {
    if (count == 0) return;
    text += (text.empty() ? log.events.path() + ": " : ", ") + std::to_string(count) + what;
  };
  add(log.events.torn_bytes(), " bytes at its end are of a record that was cut short");
  add(log.events.damaged_bytes(), " bytes between records are damaged");
  add(log.damaged_records, " records are damaged");
  return text;
}

}  // namespace darkling
