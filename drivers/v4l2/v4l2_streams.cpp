// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/v4l2_streams.h"

#include <array>
#include <utility>

#include "drivers/v4l2/v4l2_device.h"

namespace darkling {

namespace {

// A device that is asked for a frame only when poll() says that it has one.
class V4l2Stream final : public CameraStream {
 public:
  explicit V4l2Stream(std::unique_ptr<V4l2Device> device) : device_(std::move(device)) {}

  Result<void> stream_on() override { return device_->stream_on(); }
  TakenFrame take() override {
    if (!std::exchange(is_readable_, false)) return {};
    return device_->take();
  }
  void give_back(int buffer) override { device_->give_back(buffer); }
  [[nodiscard]] const std::uint8_t* pixels(int buffer) const override {
    return device_->pixels(buffer);
  }
  [[nodiscard]] std::size_t filled_bytes(int buffer) const override {
    return device_->filled_bytes(buffer);
  }
  void refresh_exposure() override { device_->refresh_exposure(); }
  [[nodiscard]] bool is_lost() const override { return device_->is_lost(); }
  [[nodiscard]] std::string loss() const override { return device_->loss(); }
  [[nodiscard]] int queued_count() const override { return device_->queued_count(); }
  [[nodiscard]] const ImageFormat& format() const override { return device_->format(); }
  [[nodiscard]] const std::vector<std::string>& remarks() const override {
    return device_->remarks();
  }
  [[nodiscard]] CameraState state() const override { return device_->state(); }

  [[nodiscard]] int descriptor() const { return device_->descriptor(); }
  void note_events(short events) {
    device_->note_events(events);
    is_readable_ = (events & POLLIN) != 0;
  }

 private:
  std::unique_ptr<V4l2Device> device_;
  bool is_readable_ = false;
};

}  // namespace

Result<std::unique_ptr<CameraStream>> V4l2Streams::open(const std::string& name,
                                                        const CameraConfig& config,
                                                        ImageExtent eye) {
  auto device = V4l2Device::open(calls_, name, config, eye);
  if (!device) return tl::unexpected<Error>(device.error());
  return std::make_unique<V4l2Stream>(std::move(*device));
}

void V4l2Streams::wait(std::span<CameraStream* const> wanted, Duration timeout) {
  std::array<pollfd, 2> polled = {{{.fd = -1, .events = 0, .revents = 0},  // -1: passed over
                                   {.fd = -1, .events = 0, .revents = 0}}};
  CHECK(wanted.size() <= polled.size(), "a rig has two cameras at most");
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    // Older kernels call it an error to wait for a device that has no buffer.
    if (wanted[i] == nullptr || wanted[i]->queued_count() == 0) continue;
    polled[i].fd = static_cast<const V4l2Stream*>(wanted[i])->descriptor();
    polled[i].events = POLLIN | POLLPRI;
  }
  if (calls_.poll(polled, timeout) <= 0) return;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (polled[i].fd >= 0) static_cast<V4l2Stream*>(wanted[i])->note_events(polled[i].revents);
  }
}

}  // namespace darkling
