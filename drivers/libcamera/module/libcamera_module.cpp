// SPDX-License-Identifier: Apache-2.0
// What the program finds in the module.
#include <cstring>
#include <memory>
#include <utility>

#include <libcamera/camera_manager.h>

#include "drivers/libcamera/module/device_camera.h"
#include "drivers/libcamera/request_camera.h"
#include "drivers/libcamera/small_stacks.h"

namespace darkling {

namespace {

// libcamera allows one manager a process.
class LinkedLibcamera final : public LibcameraCalls {
 public:
  Result<std::vector<std::string>> camera_ids() override {
    if (auto started = start(); !started) return tl::unexpected<Error>(started.error());
    std::vector<std::string> ids;
    for (const auto& camera : manager_->cameras()) ids.push_back(camera->id());
    return ids;
  }

  Result<std::unique_ptr<RequestCamera>> open(const std::string& id, const CameraConfig& config,
                                              ImageExtent eye,
                                              CompletedFrames& completed) override {
    CHECK(manager_ != nullptr, "camera_ids() comes before open()");
    auto camera = manager_->get(id);
    if (camera == nullptr) {
      return failure(ExitCode::kDeviceUnavailable,
                     "libcamera camera \"" + id + "\": has just gone");
    }
    return DeviceCamera::open(std::move(camera), config, eye, completed);
  }

  void shut_down() override {
    if (manager_ == nullptr) return;
    manager_->stop();
    manager_.reset();
  }

 private:
  Result<void> start() {
    if (manager_ != nullptr) return {};
    const SmallStacks small;
    auto manager = std::make_unique<libcamera::CameraManager>();
    if (const int error = manager->start(); error != 0) {
      return failure(ExitCode::kDeviceUnavailable,
                     std::string("libcamera cannot be started: ") + std::strerror(-error));
    }
    manager_ = std::move(manager);
    return {};
  }

  std::unique_ptr<libcamera::CameraManager> manager_;
};

}  // namespace

}  // namespace darkling

// As load_libcamera() looks it up.
extern "C" __attribute__((visibility("default"))) darkling::LibcameraCalls*
darkling_libcamera_calls() {
  static darkling::LinkedLibcamera calls;
  return &calls;
}
