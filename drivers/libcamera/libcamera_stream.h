// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/arrival_stamps.h"
#include "drivers/camera/camera_stream.h"
#include "drivers/libcamera/request_camera.h"

namespace darkling {

// A camera of libcamera as a stream of frames with stamps. libcamera does not always notice that a
// camera has gone; one that has buffers and is silent for long is taken for lost.
class LibcameraStream final : public CameraStream {
 public:
  // At least so long, and four periods. What comes of it depends on the version: 0.0.3 asserts in
  // stop() that all requests have come back, and if the driver was unbound they have not; the
  // process ends and its restart finds the camera. Not to stop would leave it without camera for
  // ever.
  static constexpr Duration kLeastSilence = std::chrono::seconds(3);

  // @param completed  where `camera` puts its frames.
  LibcameraStream(std::string id, const LibcameraCalls& calls,
                  std::unique_ptr<CompletedFrames> completed,
                  std::unique_ptr<RequestCamera> camera);

  Result<void> stream_on() override;
  TakenFrame take() override;
  void give_back(int buffer) override;
  [[nodiscard]] const std::uint8_t* pixels(int buffer) const override {
    return camera_->pixels(buffer);
  }
  [[nodiscard]] bool is_lost() const override { return lost_call_ != nullptr; }
  [[nodiscard]] std::string loss() const override;
  [[nodiscard]] int queued_count() const override;
  [[nodiscard]] const ImageFormat& format() const override { return camera_->setup().format; }
  [[nodiscard]] const std::vector<std::string>& remarks() const override {
    return camera_->setup().remarks;
  }
  [[nodiscard]] CameraState state() const override;

  [[nodiscard]] const CompletedFrames& completed() const { return *completed_; }

 private:
  // @return a negative error number, or 0.
  int queue(int buffer);
  [[nodiscard]] bool is_silent() const;
  // Says in `taken` when the frame was exposed; keeps what it says of the camera.
  void note(const CompletedFrame& frame, TakenFrame& taken);
  void lose(const char* call, int error);

  const std::string id_;
  const LibcameraCalls& calls_;
  const std::unique_ptr<CompletedFrames> completed_;  // goes after:
  const std::unique_ptr<RequestCamera> camera_;       // it still brings frames while it stops
  std::array<bool, CompletedFrames::kCapacity> is_queued_ = {};
  MonotonicTime waiting_since_ = {};  // for the next frame
  double exposure_ms_ = -1.0;
  double gain_ = -1.0;
  Duration period_ = Duration::zero();  // 0: not known
  StampSource stamp_source_ = StampSource::kUnknown;
  ArrivalStamps arrivals_;
  const char* lost_call_ = nullptr;
  int lost_error_ = 0;
};

}  // namespace darkling
