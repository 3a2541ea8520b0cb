// SPDX-License-Identifier: Apache-2.0
#include "app/service/service.h"

#include <memory>
#include <optional>

#include "app/service/journal.h"
#include "app/service/pipeline.h"
#include "platform/clocks.h"
#include "platform/realtime.h"
#include "platform/service_notify.h"
#include "platform/signals.h"

namespace darkling {

namespace {

constexpr Duration kWait = std::chrono::milliseconds(50);

Result<std::unique_ptr<Pipeline>> prepare(const ServiceOptions& options) {
  const auto config = load_config(options.config_path, options.settings);
  if (!config) return tl::unexpected(config.error());
  if (config->service.lock_memory) report_wish("lock_memory", lock_memory());
  return Pipeline::create(*config);
}

// Everything that can be wrong with the new configuration is found before the old one goes.
void reload(const ServiceOptions& options, std::unique_ptr<Pipeline>& pipeline) {
  notify_reloading();
  auto renewed = prepare(options);
  if (renewed) {
    const int reset_counter = pipeline->reset_counter() + 1;  // the pose begins anew
    pipeline.reset();
    pipeline = std::move(*renewed);
    pipeline->start(reset_counter);
    report_info("reload=done config=" + options.config_path);
  } else {
    report_error("reload=refused, the old configuration stays: " + renewed.error().message);
  }
  notify_ready();
}

// Tells systemd how the service is, from a thread that nothing else waits for: a notification may
// block. The watchdog hears of it only while every thread shows signs of life.
class Supervisor {
 public:
  Supervisor() : watchdog_period_(read_watchdog_period()), fed_at_(read_monotonic_clock()) {}

  void look_at(PipelineStatus& status) {
    if (const auto line = status.state_line.take()) notify_status(line->c_str());
    const MonotonicTime now = read_monotonic_clock();
    constexpr int kFeedsPerPeriod = 4;
    if (!watchdog_period_ || now - fed_at_ < *watchdog_period_ / kFeedsPerPeriod) return;
    if (!status.are_threads_alive(now)) return;
    feed_watchdog();
    fed_at_ = now;
  }

 private:
  std::optional<Duration> watchdog_period_;
  MonotonicTime fed_at_;
};

}  // namespace

Result<int> run_service(const ServiceOptions& options) {
  catch_stop_signals();
  catch_reload_signal();
  Supervisor supervisor;
  auto prepared = prepare(options);
  if (!prepared) return tl::unexpected(prepared.error());
  std::unique_ptr<Pipeline> pipeline = std::move(*prepared);
  pipeline->start(/*first_reset_counter=*/0);
  notify_ready();
  report_info("service=started version=" DARKLING_VERSION);
  while (!is_stop_requested() && !pipeline->is_over()) {
    static_cast<void>(sleep_until(read_monotonic_clock() + kWait));
    if (take_reload_request()) reload(options, pipeline);
    supervisor.look_at(pipeline->status());
  }
  notify_stopping();
  pipeline.reset();
  report_info("service=stopped");
  return 0;
}

}  // namespace darkling
