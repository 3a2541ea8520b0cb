// SPDX-License-Identifier: Apache-2.0
#include <spdlog/fmt/fmt.h>

#include "app/bench/bench_report.h"

namespace darkling {

namespace {

constexpr double kKiB = 1024.0;

std::string peak_table(const KernelReport& report) {
  std::string table = "This machine, arithmetic on registers\n\n";
  table += fmt::format("  {:<8}{:>16}{:>17}\n", "", "byte Gops/s", "float Gops/s");
  for (const PeakSpeed& peak : report.peaks) {
    table += fmt::format("  {:<8}{:>16.0f}{:>17.1f}\n", peak.kernels, peak.byte_operations_per_ns,
                         peak.float_operations_per_ns);
  }
  return table;
}

std::string cost_table(const KernelReport& report) {
  std::string table = fmt::format(
      "\nWhat kernels do for each unit at {}x{} px and {} points; copying as much memory\n\n"
      "  {:<18}{:<10}{:>7}{:>9}{:>10}{:>11}{:>10}{:>11}\n",
      report.width, report.height, report.points, "kernel", "unit", "units", "bytes", "byte ops",
      "float ops", "set KiB", "copy GB/s");
  for (const KernelTimings& k : report.kernels) {
    const KernelName& name = name_of(k.kernel);
    table += fmt::format("  {:<18}{:<10}{:>7}{:>9.1f}{:>10.0f}{:>11.0f}{:>10.0f}{:>11.0f}\n",
                         name.name, name.unit, k.units, k.cost.bytes, k.cost.byte_operations,
                         k.cost.float_operations, k.working_set_bytes / kKiB, k.copy_bytes_per_ns);
  }
  return table;
}

std::string percent(double share) {
  return fmt::format("{:.0f} %", 100.0 * share);
}

std::string speed_table(const KernelReport& report) {
  std::string table = fmt::format(
      "\nTheir speed: medians of {} samples, taken in turns; above them the 90th percentile;\n"
      "share of the speed that memory and arithmetic would allow, and the nearer of the two\n\n"
      "  {:<18}{:<7}{:>10}{:>8}{:>9}{:>10}{:>12}   {}\n",
      report.rounds, "kernel", "", "ns a unit", "p90", "over ref", "memory", "arithmetic",
      "nearer to");
  for (const KernelTimings& k : report.kernels) {
    const char* name = name_of(k.kernel).name;
    for (const VariantTiming& v : k.variants) {
      table += fmt::format("  {:<18}{:<7}{:>10.3f}{:>8}{:>9.2f}{:>10}{:>12}   {}\n", name,
                           v.kernels, v.time.median_ns, "+" + percent(v.time.spread), v.gain,
                           percent(v.least.memory_ns / v.time.median_ns),
                           percent(v.least.arithmetic_ns / v.time.median_ns),
                           v.least.is_memory_bound() ? "memory" : "arithmetic");
      name = "";
    }
  }
  return table;
}

std::string percentile_columns(const std::optional<Percentiles>& p) {
  return p ? fmt::format("{:>12.1f}{:>10.1f}", p->p50, p->p99)
           : fmt::format("{:>12}{:>10}", "-", "-");
}

std::string stage_table(const StageReport& report) {
  std::string table = fmt::format(
      "Stages of {} at {}x{} px, at most {} points a level, kernels {}:\n"
      "{} keyframes and {} other frames, each time the median of {} plays, microseconds\n\n"
      "  {:<10}{:>22}{:>22}{:>22}\n  {:<10}{:>12}{:>10}{:>12}{:>10}{:>12}{:>10}\n",
      report.source, report.width, report.height, report.points_per_level, report.kernels,
      report.keyframes.frames, report.others.frames, report.repeats, "", "all frames", "keyframes",
      "other frames", "stage", "p50", "p99", "p50", "p99", "p50", "p99");
  for (const StageTimes& stage : report.stages) {
    table += fmt::format("  {:<10}", stage.name) + percentile_columns(stage.all) +
             percentile_columns(stage.keyframes) + percentile_columns(stage.others) + "\n";
  }
  return table + fmt::format("\n  rectification takes {:.1f} % of the time of all frames\n",
                             100.0 * report.rectify_share);
}

KernelCost total_of(const FrameWork& work) {
  KernelCost total;
  for (const KernelWork& kernel : work) {
    total.bytes += kernel.total.bytes;
    total.byte_operations += kernel.total.byte_operations;
    total.float_operations += kernel.total.float_operations;
  }
  return total;
}

std::string frame_table(const StageReport& report) {
  std::string table = fmt::format(
      "\nA frame against this machine, means: what its kernels have to do, how long that takes at\n"
      "least, how long the kernels take by themselves, and the whole frame; microseconds\n\n"
      "  {:<14}{:>8}{:>11}{:>12}{:>9}{:>12}{:>10}{:>10}{:>10}\n",
      "", "MB", "byte Mops", "float Mops", "memory", "arithmetic", "kernels", "frame", "of bound");
  const auto add_row = [&table](const char* name, const FrameCost& cost) {
    if (cost.frames == 0) return;
    const KernelCost total = total_of(cost.work);
    table += fmt::format(
        "  {:<14}{:>8.2f}{:>11.1f}{:>12.2f}{:>9.1f}{:>12.1f}{:>10.1f}{:>10.1f}{:>10}\n", name,
        1e-6 * total.bytes, 1e-6 * total.byte_operations, 1e-6 * total.float_operations,
        1e-3 * cost.least.memory_ns, 1e-3 * cost.least.arithmetic_ns, cost.kernels_us,
        cost.measured_us, percent(1e-3 * cost.least.bound_ns() / cost.measured_us));
  };
  add_row("keyframes", report.keyframes);
  add_row("other frames", report.others);
  return table;
}

std::string exponent_text(const std::optional<PowerLaw>& law) {
  return law ? fmt::format("{:.2f}", law->exponent) : "-";
}

std::string width_table(const SweepSeries& series) {
  std::string table = fmt::format("  {:<11}{:>10}{:>14}{:>10}{:>14}{:>10}\n", "size, px", "pixels",
                                  "keyframe us", "ns a px", "other us", "ns a px");
  for (const SweepPoint& p : series.points) {
    table +=
        fmt::format("  {:<11}{:>10.0f}{:>14.1f}{:>10.2f}{:>14.1f}{:>10.2f}\n",
                    fmt::format("{}x{}", p.width, p.height), p.pixels(), p.keyframe_us,
                    1e3 * p.keyframe_us / p.pixels(), p.other_us, 1e3 * p.other_us / p.pixels());
  }
  return table + fmt::format("  grows as pixels to the power of {:>4}{:>24}\n",
                             exponent_text(series.keyframes), exponent_text(series.others));
}

std::string points_table(const SweepSeries& series) {
  std::string table = fmt::format("\n  {:<21}{:>14}{:>10}{:>14}{:>10}\n", "points a level",
                                  "keyframe us", "", "other us", "");
  for (const SweepPoint& p : series.points) {
    table += fmt::format("  {:<21}{:>14.1f}{:>10}{:>14.1f}\n", p.points_per_level, p.keyframe_us,
                         "", p.other_us);
  }
  return table + fmt::format("  grows as points to the power of {:>4}{:>24}\n",
                             exponent_text(series.keyframes), exponent_text(series.others));
}

std::string sweep_table(const SweepReport& report) {
  return fmt::format(
             "Cost of a frame of {} ({} frames), kernels {}:\nmeans of the medians of {} plays\n\n",
             report.source, report.frames, report.kernels, report.repeats) +
         width_table(report.by_width) + points_table(report.by_points);
}

}  // namespace

std::string format_bench_tables(const BenchReport& report) {
  std::string text;
  if (report.kernels) {
    text +=
        peak_table(*report.kernels) + cost_table(*report.kernels) + speed_table(*report.kernels);
  }
  if (report.stages) {
    if (!text.empty()) text += "\n";
    text += stage_table(*report.stages) + frame_table(*report.stages);
  }
  if (report.sweep) text += sweep_table(*report.sweep);
  return text;
}

}  // namespace darkling
