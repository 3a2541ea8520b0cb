// SPDX-License-Identifier: Apache-2.0
#include "app/bench/interleave.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/statistics.h"
#include "platform/clocks.h"

namespace darkling {

namespace {

// The call before the first that counts brings back to the caches what other tasks drove out.
double time_calls_ns(const std::function<void()>& task, int calls) {
  task();
  const Duration before = read_thread_cpu_time();
  for (int i = 0; i < calls; ++i) task();
  return static_cast<double>((read_thread_cpu_time() - before).count());
}

// How many calls fill a sample, by the fastest of a few trials: a slow one was disturbed.
int calls_per_sample(const std::function<void()>& task, Duration sample_time) {
  constexpr int kTrials = 3;
  const auto wanted_ns = static_cast<double>(sample_time.count());
  int calls = 1;
  for (;;) {
    double fastest_ns = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTrials; ++i) fastest_ns = std::min(fastest_ns, time_calls_ns(task, calls));
    if (4.0 * fastest_ns >= wanted_ns) {
      return std::max(1, static_cast<int>(std::lround(calls * wanted_ns / fastest_ns)));
    }
    calls *= 4;
  }
}

}  // namespace

std::vector<Timing> measure_interleaved(std::span<const std::function<void()>> tasks,
                                        const InterleavePlan& plan) {
  std::vector<int> calls;
  for (const auto& task : tasks) calls.push_back(calls_per_sample(task, plan.sample_time));
  std::vector<std::vector<double>> samples_ns(tasks.size());
  for (int round = 0; round < plan.rounds; ++round) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      samples_ns[i].push_back(time_calls_ns(tasks[i], calls[i]) / calls[i]);
    }
    if (plan.show) plan.show(round + 1, plan.rounds);
  }
  std::vector<Timing> timings;
  for (const std::vector<double>& samples : samples_ns) {
    const Percentiles p = percentiles(samples).value_or(Percentiles{});
    timings.push_back({p.p50, p.p50 > 0.0 ? p.p90 / p.p50 - 1.0 : 0.0});
  }
  return timings;
}

}  // namespace darkling
