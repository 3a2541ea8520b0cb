// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/module/device_camera.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/libcamera/module/camera_controls.h"
#include "drivers/libcamera/module/choose_format.h"
#include "platform/clocks.h"

namespace darkling {

namespace {

constexpr std::size_t kMinBufferCount = 2;  // one that is filled, one that is looked at

}  // namespace

Result<std::unique_ptr<RequestCamera>> DeviceCamera::open(std::shared_ptr<libcamera::Camera> camera,
                                                          const CameraConfig& config,
                                                          ImageExtent eye,
                                                          CompletedFrames& completed) {
  std::unique_ptr<DeviceCamera> device(new DeviceCamera(std::move(camera), completed));
  if (auto acquired = device->acquire(); !acquired) {
    return tl::unexpected<Error>(acquired.error());
  }
  if (auto set = device->set_up(config, eye); !set) return tl::unexpected<Error>(set.error());
  if (auto claimed = device->claim_buffers(); !claimed) {
    return tl::unexpected<Error>(claimed.error());
  }
  return device;
}

DeviceCamera::DeviceCamera(std::shared_ptr<libcamera::Camera> camera, CompletedFrames& completed)
    : camera_(std::move(camera)), completed_(completed) {
  camera_->requestCompleted.connect(this, &DeviceCamera::on_completed);
  camera_->disconnected.connect(this, &DeviceCamera::on_disconnected);
}

DeviceCamera::~DeviceCamera() {
  camera_->stop();
  camera_->requestCompleted.disconnect(this);
  camera_->disconnected.disconnect(this);
  requests_.clear();
  planes_.clear();
  if (allocator_ != nullptr && stream_ != nullptr) allocator_->free(stream_);
  allocator_.reset();
  configuration_.reset();
  if (is_acquired_) camera_->release();
}

tl::unexpected<Error> DeviceCamera::refuse(const std::string& what) const {
  return failure(ExitCode::kDeviceUnavailable,
                 "libcamera camera \"" + camera_->id() + "\": " + what);
}

Result<void> DeviceCamera::acquire() {
  const int error = camera_->acquire();
  if (error == -EBUSY) return refuse("another program has it; stop that one");
  if (error != 0) return refuse(std::string("cannot be had: ") + std::strerror(-error));
  is_acquired_ = true;
  return {};
}

Result<void> DeviceCamera::set_up(const CameraConfig& config, ImageExtent eye) {
  auto chosen = choose_format(*camera_, config, eye);
  if (!chosen) return tl::unexpected<Error>(chosen.error());
  configuration_ = std::move(chosen->configuration);
  setup_.format = chosen->format;
  if (const int error = camera_->configure(configuration_.get()); error != 0) {
    return refuse(std::string("cannot be configured: ") + std::strerror(-error));
  }
  stream_ = configuration_->at(0).stream();
  // Only now: the limits are those of the configuration.
  const ControlPlan plan = plan_controls("libcamera camera \"" + camera_->id() + "\"", config,
                                         read_controls(camera_->controls()));
  start_controls_ = control_list(camera_->controls(), plan);
  setup_.remarks = plan.remarks;
  setup_.period = std::chrono::microseconds(plan.period_us.value_or(0));
  return {};
}

Result<void> DeviceCamera::claim_buffers() {
  allocator_ = std::make_unique<libcamera::FrameBufferAllocator>(camera_);
  if (const int error = allocator_->allocate(stream_); error < 0) {
    return refuse(std::string("gives no buffers: ") + std::strerror(-error));
  }
  const auto& buffers = allocator_->buffers(stream_);
  if (buffers.size() < kMinBufferCount) {
    return refuse("gives " + std::to_string(buffers.size()) + " buffers; at least " +
                  std::to_string(kMinBufferCount) + " are needed");
  }
  const std::size_t count = std::min(buffers.size(), CompletedFrames::kCapacity);
  for (std::size_t i = 0; i < count; ++i) {
    auto plane = MappedPlane::map(*buffers[i], setup_.format.bytes);
    if (!plane) return refuse(plane.error().message);
    planes_.push_back(std::move(*plane));
    auto request = camera_->createRequest(i);
    if (request == nullptr || request->addBuffer(stream_, buffers[i].get()) != 0) {
      return refuse("takes no requests");
    }
    requests_.push_back(std::move(request));
  }
  is_read_.resize(count);
  setup_.buffer_count = static_cast<int>(count);
  return {};
}

int DeviceCamera::start() {
  return camera_->start(&start_controls_);
}

int DeviceCamera::queue(int buffer) {
  if (is_read_[buffer]) planes_[buffer].end_reading();
  is_read_[buffer] = false;
  libcamera::Request& request = *requests_[buffer];
  if (request.status() != libcamera::Request::RequestPending) {
    request.reuse(libcamera::Request::ReuseBuffers);
  }
  return camera_->queueRequest(&request);
}

void DeviceCamera::begin_reading(int buffer) {
  planes_[buffer].begin_reading();
  is_read_[buffer] = true;
}

void DeviceCamera::on_completed(libcamera::Request* request) {
  if (request->status() == libcamera::Request::RequestCancelled) return;  // the camera stops
  const libcamera::FrameBuffer* buffer = request->findBuffer(stream_);
  if (buffer == nullptr) return;
  const libcamera::FrameMetadata& metadata = buffer->metadata();
  CompletedFrame frame;
  frame.arrival = read_monotonic_clock();
  frame.buffer = static_cast<int>(request->cookie());
  frame.sequence = metadata.sequence;
  frame.stamp_ns = static_cast<std::int64_t>(metadata.timestamp);
  const auto planes = metadata.planes();
  frame.is_whole = metadata.status == libcamera::FrameMetadata::FrameSuccess && !planes.empty() &&
                   planes[0].bytesused >= setup_.format.bytes;
  read_metadata(request->metadata(), frame);
  completed_.push(frame);
}

}  // namespace darkling
