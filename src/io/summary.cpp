// SPDX-License-Identifier: Apache-2.0
#include <cstdarg>
#include <cstdio>

#include "io/run_report.h"

namespace darkling {

namespace {

constexpr double kMiB = 1024.0 * 1024.0;

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  char buffer[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof(buffer), format, arguments);
  va_end(arguments);
  return buffer;
}

std::string row(const char* label, const std::string& content) {
  return text("  %-11s ", label) + content + '\n';
}

std::string frame_row(const Statistics& s) {
  const auto count = [](std::int64_t n) { return std::to_string(n); };
  return row("frames", count(s.frames) + ": " + count(s.tracked_frames) + " tracked, " +
                           count(s.degraded_frames) + " degraded, " + count(s.lost_frames) +
                           " lost, " + count(s.bad_frames) + " bad");
}

// "25 refined" and, of those that were not, why: "2 step_too_large".
std::string keyframe_row(const Statistics& s) {
  std::string content = text("%lld, %lld resets", static_cast<long long>(s.keyframes),
                             static_cast<long long>(s.resets));
  for (int outcome = 1; outcome < kRefinementCount; ++outcome) {
    const auto count = static_cast<long long>(s.refinements[outcome]);
    const bool is_applied = outcome == static_cast<int>(Refinement::kApplied);
    if (count == 0) continue;
    content += text(", %lld %s", count, is_applied ? "refined" : kRefinementNames[outcome]);
  }
  return row("keyframes", content);
}

std::string fault_rows(const SourceFaults& faults) {
  std::string rows;
  const auto add = [&rows](std::int64_t count, const char* what) {
    if (count > 0) rows += row("", std::to_string(count) + " " + what);
  };
  add(faults.unreadable, "with an absent or damaged image");
  add(faults.wrong_size, "of the wrong size");
  add(faults.unpaired, "with one eye only");
  add(faults.stamps_not_increasing, "with a time stamp that repeats or goes back");
  return rows;
}

std::string time_row(const RunReport& report) {
  if (!report.statistics.frame_ms) return "";
  const Percentiles& frame_ms = *report.statistics.frame_ms;
  std::string content = text("%.2f ms a frame (p50), %.2f ms (p99)", frame_ms.p50, frame_ms.p99);
  if (report.statistics.frame_period_ms) {
    const double period_ms = *report.statistics.frame_period_ms;
    content += text(": %.1f %% of real time at %.3g Hz", 100.0 * frame_ms.p50 / period_ms,
                    1000.0 / period_ms);
  }
  return row("time", content);
}

std::string memory_row(const RunReport& report) {
  std::string content =
      text("%.1f MiB fixed at start", static_cast<double>(report.arena_bytes) / kMiB);
  if (report.heap_calls_after_start) {
    content +=
        text(", %lld heap calls after", static_cast<long long>(*report.heap_calls_after_start));
  }
  if (report.peak_rss_bytes) {
    content += text("; process peak %.0f MiB", static_cast<double>(*report.peak_rss_bytes) / kMiB);
  }
  return row("memory", content);
}

std::string nees_row(const char* label, const std::optional<Nees>& nees) {
  if (!nees) return "";
  return row(label,
             text("%.2f (translation %.2f, rotation %.2f), %.1f %% beyond 3 sigma", nees->mean,
                  nees->translation, nees->rotation, 100.0 * nees->share_beyond));
}

std::string evaluation_rows(const Evaluation& e) {
  std::string rows;
  if (e.drift_percent && e.drift_deg_per_m) {
    rows += row("drift", text("%.2f %%, %.4f deg/m", *e.drift_percent, *e.drift_deg_per_m));
  } else {
    rows += row("drift", "none: the path is shorter than 5 m");
  }
  rows += row("ATE", text("%.4f m", e.ate_rmse_m));
  rows += row("RPE", text("%.5f m, %.4f deg a frame", e.rpe_rmse_m, e.rpe_rmse_deg));
  rows += nees_row("NEES motion", e.nees_motion) + nees_row("NEES pose", e.nees_pose);
  if (e.confidence) {
    rows += row("confidence", text("%d sure frames, %zu of them wrong", e.confidence->frames,
                                   e.confidence->wrong.size()));
  }
  rows += row("end error",
              text("%.4f m, %.3f deg after %.2f m", e.end_error_m, e.end_error_deg, e.path_m));
  return rows;
}

}  // namespace

std::string format_summary(const RunReport& report) {
  std::string table = report.source + (report.was_interrupted ? "  (interrupted)\n" : "\n");
  table += frame_row(report.statistics) + fault_rows(report.faults);
  table += keyframe_row(report.statistics);
  table += row("distance", text("%.2f m", report.statistics.distance_m));
  table += row("image", text("%d x %d px, kernels %s", report.width_px, report.height_px,
                             report.kernels.c_str()));
  table += time_row(report) + memory_row(report);
  if (report.evaluation) {
    table += evaluation_rows(*report.evaluation);
    table += row("truth", report.truth);
  }
  for (const std::string& output : report.outputs) table += "  " + output + '\n';
  return table;
}

std::string format_evaluation_table(const Evaluation& evaluation) {
  return evaluation_rows(evaluation) +
         row("poses", std::to_string(evaluation.matched_poses) + " matched");
}

}  // namespace darkling
