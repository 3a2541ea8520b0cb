// SPDX-License-Identifier: Apache-2.0
#include "app/service/recorder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "app/service/claim_file.h"
#include "app/service/journal.h"
#include "app/service/wish_messages.h"
#include "drivers/framelog/rig_record.h"
#include "platform/clocks.h"
#include "platform/realtime.h"

namespace darkling {

namespace {

constexpr std::size_t kFewestSlots = 16;  // most of a second that the disk may hesitate
constexpr Duration kWait = std::chrono::milliseconds(100);
constexpr Duration kBetweenBlackBoxes = std::chrono::seconds(10);

std::size_t slot_count(const Config& config) {
  const double kept = std::ceil(config.service.black_box_s * config.camera.rate_hz);
  return kFewestSlots + static_cast<std::size_t>(kept);
}

ImageView<const std::uint8_t> copy(ImageView<const std::uint8_t> image,
                                   std::vector<std::uint8_t>& pixels) {
  for (int y = 0; y < image.height; ++y) {
    std::copy_n(image.row(y), image.width, pixels.data() + std::ptrdiff_t{y} * image.width);
  }
  return {pixels.data(), image.width, image.height, image.width};
}

// "20260131-235959", UTC.
std::string time_for_a_name() {
  const auto now = static_cast<std::time_t>(to_ns(read_epoch_clock()) / 1'000'000'000);
  std::tm utc = {};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof(text), "%Y%m%d-%H%M%S", &utc);
  return text;
}

}  // namespace

Recorder::Recorder(const Config& config, const StereoRig& rig, const std::string& source)
    : config_(config),
      rig_(rig),
      source_(source),
      slots_(slot_count(config)),
      is_recording_wanted_(config.service.record),
      black_box_at_(read_monotonic_clock() - kBetweenBlackBoxes) {
  const std::size_t pixels = static_cast<std::size_t>(rig.left.width) * rig.left.height;
  for (Slot& slot : slots_) {
    slot.left.resize(pixels);
    slot.right.resize(pixels);
  }
  begin_when_wanted();  // before the first pair: a replay needs them all
  thread_ = std::thread([this] { serve(); });
}

Recorder::~Recorder() {
  stop();
}

void Recorder::stop() {
  is_stopping_ = true;
  wake_.notify();
  if (thread_.joinable()) thread_.join();
}

void Recorder::start_recording() {
  is_recording_wanted_ = true;
  wake_.notify();
}

void Recorder::stop_recording() {
  is_recording_wanted_ = false;
  wake_.notify();
}

void Recorder::write_black_box() {
  if (config_.service.black_box_s <= 0.0) return;
  is_black_box_wanted_ = true;
  wake_.notify();
}

void Recorder::on_wish(const Wish& wish) {
  const bool is_one_more = wish_count_ == 0 || wish.kind == Wish::Kind::kReset ||
                           wishes_[wish_count_ - 1].kind != wish.kind;
  if (!is_one_more) {
    wishes_[wish_count_ - 1] = wish;  // of hints in a row the last one counts; so of reseeds
  } else if (wish_count_ < wishes_.size()) {
    wishes_[wish_count_++] = wish;
  } else {
    drops_.add();
  }
}

void Recorder::on_pair(const WaitResult& pair, const Estimate&) {
  const std::int64_t number = next_;
  Slot& slot = slots_[static_cast<std::size_t>(number) % slots_.size()];
  if (is_recording_ && number - unwritten_ >= static_cast<std::int64_t>(slots_.size())) {
    drops_.add();
    return;
  }
  Slot::State state = Slot::State::kFilled;
  const bool is_ours =
      slot.state.compare_exchange_strong(state, Slot::State::kFree) || state == Slot::State::kFree;
  if (!is_ours) {
    drops_.add();
    return;
  }
  slot.number = number;
  slot.fault = pair.status == WaitStatus::kBadFrame ? pair.fault : FrameFault::kNone;
  if (pair.status == WaitStatus::kFrame) {
    slot.frame = pair.lease.frame();
    slot.frame.left = copy(slot.frame.left, slot.left);
    slot.frame.right = copy(slot.frame.right, slot.right);
  } else {
    slot.frame = {.sequence = pair.sequence, .stamp = pair.stamp, .left = {}, .right = {}};
  }
  slot.wishes = wishes_;
  slot.wish_count = std::exchange(wish_count_, 0);
  slot.state = Slot::State::kFilled;
  next_ = number + 1;
  if (is_recording_) wake_.notify();
}

void Recorder::serve() {
  name_thread("recorder");
  for (bool is_last = false; !is_last;) {
    is_last = is_stopping_;
    static_cast<void>(wake_.wait(is_last ? Duration::zero() : kWait));
    if (is_black_box_wanted_.exchange(false)) dump_black_box();
    record_new_pairs();
  }
  if (log_) static_cast<void>(log_->close());
}

void Recorder::begin_when_wanted() {
  if (!is_recording_wanted_ || is_recording_) return;
  log_ = create(Purpose::kRecording);
  unwritten_ = next_.load();
  is_recording_ = log_.has_value();
  if (!log_) is_recording_wanted_ = false;
}

void Recorder::record_new_pairs() {
  begin_when_wanted();
  if (!is_recording_) return;
  const std::int64_t to = next_;
  const std::optional<std::int64_t> written = write(*log_, unwritten_, to);
  recorded_.add(written.value_or(0));
  if (!written) is_recording_wanted_ = false;
  unwritten_ = to;
  if (is_recording_wanted_) return;
  is_recording_ = false;
  if (auto closed = log_->close(); !closed) fail(closed.error().message);
  log_.reset();
  report_info("recording=stopped frames=" + std::to_string(recorded_.get()));
}

void Recorder::dump_black_box() {
  const MonotonicTime now = read_monotonic_clock();
  if (now - black_box_at_ < kBetweenBlackBoxes) return;
  black_box_at_ = now;
  std::optional<FrameLogWriter> log = create(Purpose::kBlackBox);
  if (!log) return;
  const std::int64_t to = next_;
  const auto kept = static_cast<std::int64_t>(slots_.size() - kFewestSlots);
  if (write(*log, std::max<std::int64_t>(0, to - kept), to)) {
    if (auto closed = log->close(); !closed) fail(closed.error().message);
  }
}

std::optional<FrameLogWriter> Recorder::create(Purpose purpose) {
  const bool is_black_box = purpose == Purpose::kBlackBox;
  const auto path = claim_file(
      config_.service.record_to + (is_black_box ? "/blackbox-" : "/darkling-") + time_for_a_name(),
      ".lcmlog");
  if (!path) {
    fail(path.error().message);
    return std::nullopt;
  }
  rig_t record = to_rig_record(rig_);
  record.source = source_;
  record.config = format_config(config_);
  record.version = DARKLING_VERSION;
  constexpr std::int64_t kBytesPerMb = 1'000'000;
  auto log = FrameLogWriter::create(*path, record, config_.service.record_limit_mb * kBytesPerMb);
  if (!log) {
    fail(log.error().message);
    std::remove(path->c_str());  // there is not even a rig in it
    return std::nullopt;
  }
  report_info((is_black_box ? "black_box=" : "recording=") + *path);
  return std::move(*log);
}

std::optional<std::int64_t> Recorder::write(FrameLogWriter& log, std::int64_t from,
                                            std::int64_t to) {
  std::int64_t written_pairs = 0;
  for (std::int64_t number = from; number < to; ++number) {
    Slot& slot = slots_[static_cast<std::size_t>(number) % slots_.size()];
    Slot::State filled = Slot::State::kFilled;
    if (!slot.state.compare_exchange_strong(filled, Slot::State::kWriting)) continue;
    const bool is_there = slot.number == number;  // and not one that came since
    const Result<void> written = is_there ? write_slot(log, slot) : Result<void>();
    slot.state = Slot::State::kFilled;
    if (!written) {
      fail(written.error().message);
      return std::nullopt;
    }
    written_pairs += is_there ? 1 : 0;
  }
  return written_pairs;
}

Result<void> Recorder::write_slot(FrameLogWriter& log, Slot& slot) {
  const Duration epoch_offset =
      read_epoch_clock().time_since_epoch() - read_monotonic_clock().time_since_epoch();
  const std::int64_t utime_us = (slot.frame.stamp.time_since_epoch() + epoch_offset).count() / 1000;
  for (std::size_t i = 0; i < slot.wish_count; ++i) {
    if (auto added = add_wish(log, slot.wishes[i], slot.frame.stamp, utime_us); !added)
      return added;
  }
  if (slot.fault == FrameFault::kNone) return log.add_frame(slot.frame, utime_us);
  return log.add_gap(slot.frame.sequence, slot.frame.stamp, slot.fault, utime_us);
}

void Recorder::fail(const std::string& error) {
  failures_.add();
  report_warning("recording=failed error=\"" + error + "\"");
}

}  // namespace darkling
