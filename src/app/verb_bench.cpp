// SPDX-License-Identifier: Apache-2.0
#include "app/verb_bench.h"

#include <cstdio>

#include "app/bench/bench_report.h"
#include "platform/cpu_features.h"
#include "platform/terminal.h"

namespace darkling {

namespace {

constexpr int kDefaultSamples = 21;
constexpr int kDefaultPlays = 10;
constexpr int kDefaultSweepPlays = 5;

// One line on standard error, rewritten, when that is a terminal.
class StepLine {
 public:
  ~StepLine() { write("\r\033[K"); }
  void show(const char* step, std::int64_t done, std::int64_t count) const {
    const std::string text = "\r\033[K" + std::string(step) + ": " + std::to_string(done) + " of " +
                             std::to_string(count);
    write(text.c_str());
  }

 private:
  void write(const char* text) const {
    if (!is_on_) return;
    std::fputs(text, stderr);
    std::fflush(stderr);
  }
  bool is_on_ = is_stderr_terminal();
};

auto show_as(const StepLine& line, const char* step) {
  return [&line, step](std::int64_t done, std::int64_t count) { line.show(step, done, count); };
}

int repeats_or(const BenchOptions& options, int otherwise) {
  return options.repeats > 0 ? options.repeats : otherwise;
}

// The reference, which gains are over, and what was asked for.
Result<std::vector<KernelTable>> tables_to_measure(const BenchOptions& options) {
  if (options.kernels.empty()) return available_tables(detect_cpu_features());
  const auto table = select_kernels(options.kernels, detect_cpu_features());
  if (!table) return tl::unexpected(table.error());
  std::vector<KernelTable> tables = {KernelTable()};
  if (table->name != std::string(KernelTable().name)) tables.push_back(*table);
  return tables;
}

Result<KernelReport> bench_kernels(const BenchOptions& options, const StepLine& line) {
  const auto tables = tables_to_measure(options);
  if (!tables) return tl::unexpected(tables.error());
  const auto workloads = KernelWorkloads::create_rendered(options.width, options.height,
                                                          options.config.points_per_level);
  if (!workloads) return tl::unexpected(workloads.error());
  return measure_kernels(
      *workloads, *tables,
      {.rounds = repeats_or(options, kDefaultSamples), .show = show_as(line, "kernels, round")});
}

Result<StageReport> bench_stages(const HeldFrames& held, const KernelTable& table,
                                 const BenchOptions& options, const StepLine& line) {
  auto report = measure_stages(held, {.config = options.config,
                                      .kernels = table,
                                      .repeats = repeats_or(options, kDefaultPlays),
                                      .show = show_as(line, "stages, play")});
  if (!report) return report;
  const auto workloads = KernelWorkloads::create(held.rig, held.frames.front(), options.config);
  if (!workloads) return tl::unexpected(workloads.error());
  const KernelReport speed = measure_kernels(
      *workloads, {&table, 1},
      {.rounds = repeats_or(options, kDefaultSamples), .show = show_as(line, "bounds, round")});
  compare_with_kernels(speed, *report);
  return report;
}

// What is measured on whole frames.
Result<void> bench_frames(const BenchOptions& options, const StepLine& line, BenchReport& report) {
  const auto table =
      select_kernels(options.kernels.empty() ? "auto" : options.kernels, detect_cpu_features());
  if (!table) return tl::unexpected(table.error());
  const auto held = hold_frames(options.source, options.frames, show_as(line, "frame"));
  if (!held) return tl::unexpected(held.error());
  if (options.has_stages) {
    auto stages = bench_stages(*held, *table, options, line);
    if (!stages) return tl::unexpected(stages.error());
    report.stages = std::move(*stages);
  }
  if (options.has_sweep) {
    auto sweep = measure_sweep(*held, {.config = options.config,
                                       .kernels = *table,
                                       .repeats = repeats_or(options, kDefaultSweepPlays),
                                       .show = show_as(line, "sweep, play")});
    if (!sweep) return tl::unexpected(sweep.error());
    report.sweep = std::move(*sweep);
  }
  return {};
}

Result<BenchReport> measure(const BenchOptions& options) {
  const StepLine line;
  BenchReport report;
  if (options.has_kernels) {
    auto kernels = bench_kernels(options, line);
    if (!kernels) return tl::unexpected(kernels.error());
    report.kernels = std::move(*kernels);
  }
  if (options.has_stages || options.has_sweep) {
    if (auto done = bench_frames(options, line, report); !done) {
      return tl::unexpected(done.error());
    }
  }
  return report;
}

}  // namespace

Result<int> run_bench(const BenchOptions& options) {
  const auto report = measure(options);
  if (!report) return tl::unexpected(report.error());
  const std::string text =
      options.is_json ? format_bench_json(*report) : format_bench_tables(*report);
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace darkling
