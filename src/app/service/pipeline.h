// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "app/service/capture_thread.h"
#include "app/service/command_thread.h"
#include "app/service/odometry_thread.h"
#include "app/service/open_camera.h"
#include "app/service/output_thread.h"
#include "app/service/pipeline_status.h"
#include "app/service/recorder.h"
#include "app/service/refinement_thread.h"
#include "io/config.h"
#include "vo/odometry.h"

namespace darkling {

// Cameras in, messages out: all that the service does, and what it needs for it.
//   camera → capture → (pairs) → odometry → (estimates) → output → LCM
//                                 ↑ wishes ← commands ← LCM
class Pipeline {
 public:
  // Checks the configuration as a whole and claims the odometry's memory; opens no device.
  // @return what open_camera() and Odometry::create() refuse.
  static Result<std::unique_ptr<Pipeline>> create(const Config& config);
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  // Starts the threads. @pre once.
  // @param first_reset_counter  0, or one more than of the pipeline that this one takes over from.
  void start(std::optional<Duration> watchdog_period, int first_reset_counter);
  // @pre start().
  [[nodiscard]] int reset_counter() const { return output_->reset_counter(); }
  // A recording that stands in for a camera has come to its end, and all of it is published.
  [[nodiscard]] bool is_over() const;

 private:
  Pipeline(const Config& config, LiveCamera camera, const KernelTable& kernels);
  void obey(std::int8_t command);

  Config config_;
  LiveCamera camera_;
  KernelTable kernels_;
  PipelineStatus status_;
  PairRing pairs_;
  EstimateRing estimates_;
  WishRing wishes_;
  WakeUp odometry_wake_;
  WakeUp output_wake_;
  RefinementThread refinement_;
  std::unique_ptr<Odometry> odometry_;
  std::unique_ptr<Recorder> recorder_;  // null: record_to is empty
  // In the order in which they start; they stop the other way round, but for the output, which has
  // the last word.
  std::unique_ptr<CaptureThread> capture_;
  std::unique_ptr<OdometryThread> tracker_;
  std::unique_ptr<OutputThread> output_;
  std::unique_ptr<CommandThread> commands_;
};

}  // namespace darkling
