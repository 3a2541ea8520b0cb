// SPDX-License-Identifier: Apache-2.0
#include "app/replay_log.h"

#include <array>
#include <cstdio>
#include <filesystem>

#include "app/service/claim_file.h"
#include "app/truth_record.h"
#include "drivers/framelog/rig_record.h"
#include "messages/channels.h"
#include "messages/wire.h"

namespace darkling {

namespace {

constexpr std::size_t kMostBytes = 4096;  // of a message; as of the service

Result<std::string> claim(const std::string& path) {
  const std::filesystem::path name(path);
  std::error_code error;
  if (!name.has_filename() || std::filesystem::is_directory(name, error)) {
    return failure(ExitCode::kUsage, path + ": is a folder; name a file in it");
  }
  return claim_file((name.parent_path() / name.stem()).string(), name.extension().string());
}

}  // namespace

Result<ReplayLog> ReplayLog::create(const std::string& path, const Config& config,
                                    const StereoRig& rig, const std::optional<Trajectory>& truth,
                                    const ReplayFacts& facts) {
  auto claimed = claim(path);
  if (!claimed) return tl::unexpected(claimed.error());
  rig_t record = to_rig_record(rig);
  record.source = facts.source;
  record.config = format_config(config);
  record.version = DARKLING_VERSION;
  auto writer = FrameLogWriter::create(*claimed, record);
  if (!writer) {
    std::remove(claimed->c_str());  // there is not even a rig in it
    return tl::unexpected(writer.error());
  }
  if (truth) {
    if (auto added = writer->add_truth(to_truth_record(*truth)); !added) {
      return tl::unexpected(added.error());
    }
  }
  return ReplayLog(std::move(*claimed), std::move(*writer), config, facts);
}

ReplayLog::ReplayLog(std::string path, FrameLogWriter writer, const Config& config,
                     const ReplayFacts& facts)
    : path_(std::move(path)),
      writer_(std::move(writer)),
      prefix_(config.service.channel_prefix),
      has_bot_core_pose_(config.service.bot_core_pose),
      status_(facts) {}

Result<void> ReplayLog::add(const WaitResult& pair, std::span<const RecordedWish> obeyed,
                            const Estimate& estimate) {
  last_stamp_ = estimate.stamp;
  if (auto added = add_wishes(writer_, obeyed, estimate.stamp); !added) return added;
  auto added = pair.status == WaitStatus::kFrame
                   ? writer_.add_frame(pair.lease.frame())
                   : writer_.add_gap(pair.sequence, pair.stamp, pair.fault);
  if (!added) return added;
  if (auto published = publish(estimate); !published) return published;
  status_.add(pair, estimate);
  return publish(status_.take_due(), estimate.stamp);
}

Result<void> ReplayLog::publish(const Estimate& estimate) {
  // Stamps of a recording tell `utime` as far as anything does: no wall clock comes into the log.
  messages_.fill(estimate, /*epoch_offset=*/Duration::zero());
  auto done = publish(kUpdateChannel, messages_.update(), estimate.stamp);
  if (done) done = publish(kPoseChannel, messages_.pose(), estimate.stamp);
  if (done && has_bot_core_pose_) {
    done = publish(kBotCorePoseChannel, messages_.bot_core_pose(), estimate.stamp);
  }
  return done;
}

Result<void> ReplayLog::publish(const std::optional<status_t>& status, FrameTime stamp) {
  return status ? publish(kStatusChannel, *status, stamp) : Result<void>();
}

template <class Message>
Result<void> ReplayLog::publish(std::string_view channel, const Message& message, FrameTime stamp) {
  std::array<std::byte, kMostBytes> buffer;
  const auto bytes = std::span(buffer).first(encode_into(std::span(buffer), message));
  return writer_.add_message((prefix_ + std::string(channel)).c_str(), bytes, stamp);
}

Result<void> ReplayLog::close() {
  const auto published = publish(status_.take_last(), last_stamp_);
  const auto closed = writer_.close();
  return published ? closed : published;
}

}  // namespace darkling
