// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/frame_source.h"
#include "drivers/injection/injection.h"

namespace darkling {

// The frames of another source with what goes wrong with light, sensors and transport put in, one
// injection after the other. The same frames give the same pixels, bad frames and stamps on every
// run. Images are copied once, into buffers that start() claims.
class InjectedSource final : public FrameSource {
 public:
  // How many frames may be on loan at once; wait_next() times out while all are.
  static constexpr int kSlotCount = 3;

  // @param size  what both images of every pair measure, in px; others become kWrongSize.
  InjectedSource(std::unique_ptr<FrameSource> source, ImageSize size,
                 const std::vector<Injection>& injections);

  Result<void> start() override;
  WaitResult wait_next(Duration timeout) override;
  void stop() override;
  [[nodiscard]] std::vector<std::string> remarks() const override { return source_->remarks(); }
  // Those of the source, where what was lost here counts as lost.
  [[nodiscard]] SourceStats stats() const override;
  [[nodiscard]] CameraState camera_state() const override { return source_->camera_state(); }

 private:
  struct Slot {
    std::vector<std::uint8_t> pixels;  // left image, then right
    std::atomic<bool> is_on_loan;      // false at first
  };
  struct Stage {
    Injection injection;
    std::unique_ptr<Injector> injector;
  };

  [[nodiscard]] FrameFault copy_and_inject(const StereoFrame& frame, Slot& slot,
                                           InjectedPair& pair);
  [[nodiscard]] WaitResult lose(const StereoFrame& frame, FrameFault fault);
  static void give_back(void* source, int slot);

  std::unique_ptr<FrameSource> source_;
  ImageSize size_;
  std::vector<Stage> stages_;
  std::array<Slot, kSlotCount> slots_;
  std::atomic<std::int64_t> lost_unreadable_ = 0;  // whole pairs of the source
  std::atomic<std::int64_t> lost_wrong_size_ = 0;
};

}  // namespace darkling
