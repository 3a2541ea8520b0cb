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
#include "drivers/camera/camera_stream.h"
#include "drivers/camera/jpeg_luma.h"
#include "drivers/frame_source.h"
#include "drivers/pairing/number_pairs.h"
#include "drivers/pairing/pair_frames.h"
#include "drivers/published_state.h"

namespace darkling {

// Stereo pairs of one camera that shows both eyes in an image, or of two cameras. Grey images are
// delivered where the camera has put them; others are converted into buffers of our own. Sequence
// numbers count pairs, with gaps for what a camera lost; over stop() and start() they go on, with a
// gap for the time between.
// Thread: one at a time calls start(), wait_next() and stop(), and only it talks to the cameras; a
// lease given back on another leaves a mark that the next wait_next() sees.
class StreamSource : public FrameSource {
 public:
  // How many pairs may be on loan at once, while the cameras have buffers left.
  static constexpr int kSlotCount = 4;

  // @param names  of the cameras, left and right, or the one of both.
  // @param eye    the calibration's size of one image, in px.
  // @pre check_camera_settings() has nothing against them.
  StreamSource(const CameraConfig& config, std::vector<std::string> names, ImageExtent eye,
               std::unique_ptr<CameraStreams> cameras);
  ~StreamSource() override;

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override;
  [[nodiscard]] std::vector<std::string> remarks() const override;
  [[nodiscard]] SourceStats stats() const override { return published_stats_.load(); }
  [[nodiscard]] CameraState camera_state() const override { return published_camera_.load(); }

 private:
  enum class SlotState { kFree = 0, kOnLoan, kReturned };
  // What a lease holds: buffers of the cameras (-1: none), or copies.
  struct Slot {
    std::atomic<SlotState> state = SlotState::kFree;
    std::array<int, 2> buffers = {-1, -1};
    std::array<std::vector<std::uint8_t>, 2> copies;
  };

  Result<void> open_streams();
  void claim_slots();
  [[nodiscard]] std::int64_t pairs_since(FrameTime stamp) const;
  void clear();
  [[nodiscard]] bool is_lost() const;
  void reclaim_slots();
  [[nodiscard]] Slot* free_slot();
  // Waits until a camera has a frame, a lease may have come back, or the time is over.
  void wait_for_streams(Duration timeout);
  // What can be delivered now; kUnknown: nothing.
  WaitResult next_shared(Slot& slot);
  WaitResult next_pair(Slot& slot);
  void take_eyes();
  TakenFrame take_from(std::size_t camera, std::int64_t& index);
  // The grey image of a buffer, in place or as a copy in the slot; empty when it cannot be decoded.
  ImageView<const std::uint8_t> bring(std::size_t camera, int buffer, Slot& slot);
  // Gives the cameras the buffers of a slot.
  void give_buffers_back(Slot& slot);
  WaitResult report_unreadable(std::int64_t number, FrameTime stamp);
  WaitResult deliver_pair(const PairResult& pair, Slot& slot);
  WaitResult report_unpaired(Eye eye, const StampedFrame& frame);
  WaitResult lend(const StereoFrame& frame, Slot& slot);
  static void give_back(void* source, int slot);

  const CameraConfig config_;
  std::vector<std::string> names_;  // left and right, or the one of both
  const ImageExtent eye_;
  const std::unique_ptr<CameraStreams> cameras_;

  std::array<Slot, kSlotCount> slots_;
  std::array<std::unique_ptr<CameraStream>, 2> streams_;  // those not open are null
  std::array<std::optional<JpegLuma>, 2> decoders_;       // of cameras that need one
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
