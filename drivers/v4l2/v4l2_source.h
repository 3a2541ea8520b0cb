// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_config.h"
#include "base/result.h"
#include "drivers/frame_source.h"
#include "drivers/pairing/number_pairs.h"
#include "drivers/pairing/pair_frames.h"
#include "drivers/v4l2/published_state.h"
#include "drivers/v4l2/v4l2_device.h"

namespace darkling {

// Stereo pairs of one V4L2 device that shows both eyes in an image, or of two devices. Grey images
// are delivered where the device has put them; others are converted into buffers of our own.
// Sequence numbers count pairs, with gaps for what a device lost; over stop() and start() they go
// on, with a gap for the time between.
// Thread: one at a time calls start(), wait_next() and stop(), and only it talks to the devices; a
// lease given back on another leaves a mark that the next wait_next() sees.
class V4l2Source final : public FrameSource {
 public:
  // How many pairs may be on loan at once, while the devices have buffers left.
  static constexpr int kSlotCount = 4;

  // @param eye  the calibration's size of one image, in px.
  // @return kUsage when the source's text is wrong, kConfiguration when the settings do not fit it.
  static Result<std::unique_ptr<V4l2Source>> create(const CameraConfig& config, ImageExtent eye,
                                                    DeviceCalls& calls = linux_device_calls());
  ~V4l2Source() override;

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override;
  [[nodiscard]] std::vector<std::string> remarks() const override;
  [[nodiscard]] SourceStats stats() const override { return published_stats_.load(); }
  [[nodiscard]] CameraState camera_state() const override { return published_camera_.load(); }

 private:
  enum class SlotState { kFree = 0, kOnLoan, kReturned };
  // What a lease holds: buffers of the devices (-1: none), or copies.
  struct Slot {
    std::atomic<SlotState> state = SlotState::kFree;
    std::array<int, 2> buffers = {-1, -1};
    std::array<std::vector<std::uint8_t>, 2> copies;
  };

  V4l2Source(const CameraConfig& config, std::vector<std::string> paths, ImageExtent eye,
             DeviceCalls& calls);

  Result<void> open_devices();
  void claim_slots();
  [[nodiscard]] std::int64_t pairs_since(FrameTime stamp) const;
  void clear();
  [[nodiscard]] bool is_lost() const;
  void reclaim_slots();
  [[nodiscard]] Slot* free_slot();
  // Waits until a device has a frame, a lease may have come back, or the time is over.
  void wait_for_devices(Duration timeout);
  // What can be delivered now; kUnknown: nothing.
  WaitResult next_shared(Slot& slot);
  WaitResult next_pair(Slot& slot);
  void take_eyes();
  TakenFrame take_from(std::size_t device, std::int64_t& index);
  // The grey image of a buffer, in place or as a copy in the slot.
  ImageView<const std::uint8_t> bring(std::size_t device, int buffer, Slot& slot);
  WaitResult deliver_pair(const PairResult& pair, Slot& slot);
  WaitResult report_unpaired(Eye eye, const StampedFrame& frame);
  WaitResult lend(const StereoFrame& frame, Slot& slot);
  static void give_back(void* source, int slot);

  const CameraConfig config_;
  const std::vector<std::string> paths_;  // left and right, or the one of both
  const ImageExtent eye_;
  DeviceCalls& calls_;

  std::array<Slot, kSlotCount> slots_;
  std::array<std::unique_ptr<V4l2Device>, 2> devices_;  // those not open are null
  std::array<bool, 2> is_readable_ = {};
  std::array<FrameIndex, 2> indices_;
  std::optional<PairFrames> pairing_;
  NumberPairs numbers_;
  std::optional<FrameTime> last_stamp_;  // of the pair delivered last
  Duration last_skew_ = Duration::zero();
  SourceStats stats_;
  PublishedStats published_stats_;
  PublishedCamera published_camera_;
};

}  // namespace darkling
