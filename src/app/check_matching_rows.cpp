// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <string>

#include "app/check_cameras.h"
#include "base/number_text.h"
#include "platform/clocks.h"
#include "platform/cpu_features.h"
#include "vo/check_epipolar.h"

namespace darkling {

namespace {

constexpr const char* kName = "image rows";
constexpr int kPairs = 5;
constexpr int kMostFaults = 50;  // pairs that are none, before it is given up
constexpr Duration kPatience = std::chrono::seconds(5);

// Hundredths are what a fit of so many points is good for.
std::string hundredths(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

Result<void> check_sizes(const StereoFrame& frame, const StereoRig& rig) {
  const bool fit = frame.left.has_size(rig.left.width, rig.left.height) &&
                   frame.right.has_size(rig.right.width, rig.right.height);
  if (fit) return {};
  return failure(ExitCode::kConfiguration,
                 "the images are " + size_text(frame.left.width, frame.left.height) +
                     ", the calibration is for " + size_text(rig.left.width, rig.left.height) +
                     "; both must be the same");
}

// Shows the first pairs of a started source to `check`.
// @return how many.
Result<int> show_pairs(FrameSource& source, const StereoRig& rig, EpipolarCheck& check) {
  const MonotonicTime give_up_at = read_monotonic_clock() + kPatience;
  int shown = 0;
  int faults = 0;
  while (shown < kPairs && faults < kMostFaults && read_monotonic_clock() < give_up_at) {
    const WaitResult next = source.wait_next(std::chrono::milliseconds(200));
    if (next.status == WaitStatus::kEndOfSource || next.status == WaitStatus::kDeviceLost) break;
    if (next.status == WaitStatus::kBadFrame) ++faults;
    if (next.status != WaitStatus::kFrame) continue;
    const auto sizes = check_sizes(next.lease.frame(), rig);
    if (!sizes) return tl::unexpected(sizes.error());
    check.add(next.lease.frame());
    ++shown;
  }
  if (shown > 0) return shown;
  return failure(ExitCode::kDeviceUnavailable,
                 "no pair of images came within 5 s; are both cameras streaming, and in step? "
                 "Pairs may be apart by max_skew_ms at most");
}

void judge_report(const EpipolarReport& report, int pairs, CheckRows& rows) {
  const std::string found = hundredths(report.median_abs_px) + " px apart, median of " +
                            std::to_string(report.matches) + " points in " + std::to_string(pairs) +
                            " pairs";
  if (report.matches < kFewestEpipolarMatches) {
    rows.warning(kName, "only " + std::to_string(report.matches) + " of " +
                            std::to_string(report.corners) +
                            " corners of the left eye are found in the right, too few to judge the "
                            "calibration; is there light, do both see the same, are the eyes "
                            "swapped?");
    return;
  }
  if (report.median_abs_px < kMostEpipolarOffset_px) {
    rows.ok(kName, found);
    return;
  }
  rows.wrong(kName, {ExitCode::kConfiguration,
                     "what both eyes see is " + found + "; allowed is less than " +
                         number_text(kMostEpipolarOffset_px) +
                         " px of the thumbnail. The right image looks shifted by " +
                         hundredths(report.median_px) + " px, turned by " +
                         hundredths(report.roll_deg) + "° and " + hundredths(report.scale) +
                         " times as large: the calibration is not of these cameras as they are "
                         "now; calibrate again"});
}

}  // namespace

void check_matching_rows(const OdometryConfig& config, const CheckedEyes& eyes, CheckRows& rows) {
  if (!eyes.rig || eyes.source == nullptr) {
    rows.not_checked(kName, "needs a calibration, and a SOURCE or a camera with images");
    return;
  }
  const int width_px = std::min(config.width_px, eyes.rig->left.width);
  const auto kernels = select_kernels("auto", detect_cpu_features());
  const auto check = EpipolarCheck::create(*eyes.rig, width_px, kernels ? *kernels : KernelTable());
  if (!check) {
    rows.wrong(kName, check.error());
    return;
  }
  if (const auto started = eyes.source->start(); !started) {
    rows.wrong(kName, started.error());
    return;
  }
  const auto pairs = show_pairs(*eyes.source, *eyes.rig, **check);
  eyes.source->stop();
  if (!pairs) {
    rows.wrong(kName, pairs.error());
    return;
  }
  judge_report((*check)->report(), *pairs, rows);
}

}  // namespace darkling
