// SPDX-License-Identifier: Apache-2.0
#include "app/service/pipeline.h"

#include <cmath>
#include <utility>

#include "app/service/journal.h"
#include "messages/command_t.hpp"
#include "platform/clocks.h"
#include "platform/cpu_features.h"

namespace darkling {

Result<std::unique_ptr<Pipeline>> Pipeline::create(const Config& config) {
  auto camera = open_camera(config);
  if (!camera) return tl::unexpected(camera.error());
  return create(config, std::move(*camera));
}

Result<std::unique_ptr<Pipeline>> Pipeline::create(const Config& config, LiveCamera camera) {
  const auto kernels = select_kernels("auto", detect_cpu_features());
  if (!kernels) return tl::unexpected(kernels.error());
  std::unique_ptr<Pipeline> pipeline(new Pipeline(config, std::move(camera), *kernels));
  auto odometry = Odometry::create(config.odometry, pipeline->camera_.rig, *kernels,
                                   read_monotonic_clock, &pipeline->refinement_);
  if (!odometry) return tl::unexpected(odometry.error());
  pipeline->odometry_ = std::move(*odometry);
  return pipeline;
}

Pipeline::Pipeline(const Config& config, LiveCamera camera, const KernelTable& kernels)
    : config_(config), camera_(std::move(camera)), kernels_(kernels) {}

void Pipeline::start(int first_reset_counter) {
  const RectifiedRig& rig = odometry_->rig();
  const PipelineFacts facts{
      .camera = camera_.name,
      .kernels = kernels_.name,
      .version = DARKLING_VERSION,
      .arena_bytes = static_cast<std::int64_t>(odometry_->arena_bytes()),
      .width_px = rig.width,
      .height_px = rig.height,
      .period = Duration(std::llround(1e9 / config_.camera.rate_hz)),
      .first_reset_counter = first_reset_counter,
  };
  if (!config_.service.record_to.empty()) {
    recorder_ = std::make_unique<Recorder>(config_, camera_.rig, camera_.name);
  }
  capture_ = std::make_unique<CaptureThread>(
      CaptureThread::Links{*camera_.source, pairs_, odometry_wake_, status_},
      config_.service.realtime_priority);
  tracker_ = std::make_unique<OdometryThread>(
      OdometryThread::Links{*odometry_, pairs_, wishes_, odometry_wake_, estimates_, output_wake_,
                            status_, recorder_.get()},
      config_.service.cpu);
  output_ = std::make_unique<OutputThread>(
      OutputThread::Links{estimates_, output_wake_, status_, *capture_, *camera_.source,
                          recorder_.get()},
      facts, config_.service);
  commands_ = std::make_unique<CommandThread>(
      CommandThread::Links{wishes_, [this](std::int8_t command) { obey(command); }},
      config_.service.lcm_url, config_.service.channel_prefix);
}

Pipeline::~Pipeline() {
  status_.is_stopping = true;
  commands_.reset();
  // The source stops only when it has all its pairs back, so the one who takes them goes later; and
  // the output goes last, but speaks of the capture thread and of the recorder.
  if (capture_ != nullptr) capture_->stop();
  tracker_.reset();
  if (recorder_ != nullptr) recorder_->stop();
  output_.reset();
  recorder_.reset();
  capture_.reset();
}

// What is not for the odometry. Thread: that of the commands.
void Pipeline::obey(std::int8_t command) {
  if (command == command_t::COMMAND_ZERO_COUNTERS) return output_->zero_counters();
  if (recorder_ == nullptr) {
    return report_warning("command=" + std::to_string(command) + " ignored: record_to is empty");
  }
  switch (command) {
    case command_t::COMMAND_START_RECORDING:
      return recorder_->start_recording();
    case command_t::COMMAND_STOP_RECORDING:
      return recorder_->stop_recording();
    case command_t::COMMAND_WRITE_BLACK_BOX:
      return recorder_->write_black_box();
    default:
      return;
  }
}

bool Pipeline::is_over() const {
  return status_.is_source_over && status_.pairs_in_flight.load(std::memory_order_acquire) == 0;
}

}  // namespace darkling
