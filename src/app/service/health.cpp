// SPDX-License-Identifier: Apache-2.0
#include "app/service/health.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "messages/status_t.hpp"

namespace darkling {

namespace {

constexpr std::array<const char*, kServiceStateCount> kStateNames = {
    "UNKNOWN", "INIT", "TRACKING", "DEGRADED", "LOST", "NO_CAMERA", "FAULT"};

struct NamedReason {
  std::uint32_t bit;
  const char* name;
};
// Beside those of a frame.
constexpr std::array kServiceReasons = std::to_array<NamedReason>({
    {kReasonNoFrames, "no_frames"},
    {kReasonLate, "late"},
    {kReasonClockStepped, "clock_stepped"},
    {kReasonNotPublished, "not_published"},
    {kReasonRecordingFailed, "recording_failed"},
});

// So many periods without a frame, or so long at least, is a camera that is gone.
constexpr int kSilentPeriods = 5;
constexpr Duration kLeastSilence = std::chrono::milliseconds(500);

static_assert(status_t::STATE_INIT == static_cast<int>(ServiceState::kInit));
static_assert(status_t::STATE_TRACKING == static_cast<int>(ServiceState::kTracking));
static_assert(status_t::STATE_DEGRADED == static_cast<int>(ServiceState::kDegraded));
static_assert(status_t::STATE_LOST == static_cast<int>(ServiceState::kLost));
static_assert(status_t::STATE_NO_CAMERA == static_cast<int>(ServiceState::kNoCamera));
static_assert(status_t::STATE_FAULT == static_cast<int>(ServiceState::kFault));
static_assert(status_t::REASON_NO_FRAMES == static_cast<int>(kReasonNoFrames));
static_assert(status_t::REASON_LATE == static_cast<int>(kReasonLate));
static_assert(status_t::REASON_CLOCK_STEPPED == static_cast<int>(kReasonClockStepped));
static_assert(status_t::REASON_NOT_PUBLISHED == static_cast<int>(kReasonNotPublished));
static_assert(status_t::REASON_RECORDING_FAILED == static_cast<int>(kReasonRecordingFailed));

}  // namespace

const char* name_of(ServiceState state) {
  return kStateNames[static_cast<std::size_t>(state)];
}

ServiceState state_from_message(std::int8_t state) {
  if (state < 0 || state >= kServiceStateCount) return ServiceState::kUnknown;
  return static_cast<ServiceState>(state);
}

std::vector<std::string> names_of_reasons(std::uint32_t reasons) {
  std::vector<std::string> names;
  const auto take = [&](std::uint32_t bit, const char* name) {
    if ((reasons & bit) != 0) names.emplace_back(name);
    reasons &= ~bit;
  };
  for (int bit = 0; bit < kReasonCount; ++bit) take(1u << bit, kReasonNames[bit]);
  for (const NamedReason& reason : kServiceReasons) take(reason.bit, reason.name);
  for (std::uint32_t bit = 1; reasons != 0; bit <<= 1) {
    if ((reasons & bit) == 0) continue;
    char name[16];
    std::snprintf(name, sizeof(name), "0x%x", bit);
    names.emplace_back(name);
    reasons &= ~bit;
  }
  return names;
}

std::string describe_reasons(std::uint32_t reasons) {
  std::string text;
  for (const std::string& name : names_of_reasons(reasons)) {
    text.append(text.empty() ? "" : ",").append(name);
  }
  return text.empty() ? "none" : text;
}

Health::Health(MonotonicTime now, Duration period)
    : last_frame_at_(now), silence_(std::max(kSilentPeriods * period, kLeastSilence)) {}

void Health::observe(const Estimate& estimate, MonotonicTime now) {
  last_frame_at_ = now;
  last_status_ = estimate.status;
  reasons_ |= estimate.reasons;
}

ServiceState Health::judge(MonotonicTime now, Camera camera, bool are_threads_alive) {
  if (!are_threads_alive) return ServiceState::kFault;
  if (camera == Camera::kOpening) {
    last_frame_at_ = now;
    return ServiceState::kInit;
  }
  if (camera == Camera::kAbsent || now - last_frame_at_ > silence_) {
    reasons_ |= kReasonNoFrames;
    return ServiceState::kNoCamera;
  }
  switch (last_status_) {
    case TrackStatus::kUnknown:
      return ServiceState::kInit;
    case TrackStatus::kValid:
      return ServiceState::kTracking;
    case TrackStatus::kDegraded:
      return ServiceState::kDegraded;
    case TrackStatus::kLost:
      return ServiceState::kLost;
  }
  return ServiceState::kUnknown;
}

std::uint32_t Health::take_reasons() {
  return std::exchange(reasons_, 0);
}

}  // namespace darkling
