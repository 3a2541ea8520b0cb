// SPDX-License-Identifier: Apache-2.0
#include "app/service/service.h"

#include <memory>

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
void reload(const ServiceOptions& options, std::optional<Duration> watchdog_period,
            std::unique_ptr<Pipeline>& pipeline) {
  notify_reloading();
  auto renewed = prepare(options);
  if (renewed) {
    const int reset_counter = pipeline->reset_counter() + 1;  // the pose begins anew
    pipeline.reset();
    pipeline = std::move(*renewed);
    pipeline->start(watchdog_period, reset_counter);
    report_info("reload=done config=" + options.config_path);
  } else {
    report_error("reload=refused, the old configuration stays: " + renewed.error().message);
  }
  notify_ready();
}

}  // namespace

Result<int> run_service(const ServiceOptions& options) {
  catch_stop_signals();
  catch_reload_signal();
  const std::optional<Duration> watchdog_period = read_watchdog_period();
  auto prepared = prepare(options);
  if (!prepared) return tl::unexpected(prepared.error());
  std::unique_ptr<Pipeline> pipeline = std::move(*prepared);
  pipeline->start(watchdog_period, 0);
  notify_ready();
  report_info("service=started version=" DARKLING_VERSION);
  while (!is_stop_requested() && !pipeline->is_over()) {
    static_cast<void>(sleep_until(read_monotonic_clock() + kWait));
    if (take_reload_request()) reload(options, watchdog_period, pipeline);
  }
  notify_stopping();
  pipeline.reset();
  report_info("service=stopped");
  return 0;
}

}  // namespace darkling
