// SPDX-License-Identifier: Apache-2.0
#include "vm/message_text.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace darkling::test {

namespace {

template <class T>
std::string text(const T& value) {
  std::ostringstream stream;
  stream.precision(9);
  stream << value;
  return stream.str();
}

std::string word(std::string value) {
  std::replace(value.begin(), value.end(), ' ', '_');
  return value;
}

std::string vector_text(const double (&v)[3]) {
  return text(v[0]) + "," + text(v[1]) + "," + text(v[2]);
}

template <std::size_t N>
std::string name_of(int value, const std::array<std::string_view, N>& names) {
  if (value < 0 || value >= static_cast<int>(N)) return text(value);
  return std::string(names[static_cast<std::size_t>(value)]);
}

// In the order of the messages' constants.
constexpr std::array<std::string_view, 4> kStatusNames = {"UNKNOWN", "VALID", "DEGRADED", "LOST"};
constexpr std::array<std::string_view, 7> kStateNames = {
    "UNKNOWN", "INIT", "TRACKING", "DEGRADED", "LOST", "NO_CAMERA", "FAULT"};

bool meets(const std::string& found, const Condition& condition) {
  if (condition.comparison == "=") return found == condition.value;
  if (condition.comparison == "!=") return found != condition.value;
  const double difference = std::stod(found) - std::stod(condition.value);
  return condition.comparison == "<" ? difference < 0.0 : difference > 0.0;
}

}  // namespace

Fields fields_of(const update_t& update) {
  return {{"mono_ns", text(update.mono_ns)},
          {"seq", text(update.seq)},
          {"reset_counter", text(update.reset_counter)},
          {"status", name_of(update.status, kStatusNames)},
          {"quality", text(static_cast<int>(update.quality))},
          {"reasons", text(update.reasons)},
          {"translation", vector_text(update.translation)}};
}

Fields fields_of(const pose_t& pose) {
  return {{"mono_ns", text(pose.mono_ns)},
          {"seq", text(pose.seq)},
          {"reset_counter", text(pose.reset_counter)},
          {"status", name_of(pose.status, kStatusNames)},
          {"quality", text(static_cast<int>(pose.quality))},
          {"translation", vector_text(pose.translation)}};
}

Fields fields_of(const status_t& status) {
  return {{"mono_ns", text(status.mono_ns)},
          {"state", name_of(status.state, kStateNames)},
          {"reasons", text(status.reasons)},
          {"reset_counter", text(status.reset_counter)},
          {"uptime_s", text(status.uptime_s)},
          {"frames_in", text(status.frames_in)},
          {"frames_tracked", text(status.frames_tracked)},
          {"frames_lost", text(status.frames_lost)},
          {"frames_skipped", text(status.frames_skipped)},
          {"frames_unpaired", text(status.frames_unpaired)},
          {"frames_bad", text(status.frames_bad)},
          {"device_dropped", text(status.device_dropped)},
          {"device_errors", text(status.device_errors)},
          {"publish_failures", text(status.publish_failures)},
          {"deadline_misses", text(status.deadline_misses)},
          {"rate_in_hz", text(status.rate_in_hz)},
          {"rate_out_hz", text(status.rate_out_hz)},
          {"latency_p50_ms", text(status.latency_p50_ms)},
          {"latency_max_ms", text(status.latency_max_ms)},
          {"exposure_ms", text(status.exposure_ms)},
          {"gain", text(status.gain)},
          {"skew_ms", text(status.skew_ms)},
          {"stamp_source", text(static_cast<int>(status.stamp_source))},
          {"stamp_uncertainty_ms", text(status.stamp_uncertainty_ms)},
          {"arena_bytes", text(status.arena_bytes)},
          {"rss_bytes", text(status.rss_bytes)},
          {"heap_calls", text(status.heap_calls)},
          {"is_recording", text(static_cast<int>(status.is_recording))},
          {"recorded_frames", text(status.recorded_frames)},
          {"record_drops", text(status.record_drops)},
          {"width", text(status.width)},
          {"kernels", word(status.kernels)},
          {"camera", word(status.camera)}};
}

Condition parse_condition(const std::string& text) {
  const std::size_t start = text.find_first_of("=!<>");
  if (start == std::string::npos || start == 0)
    throw std::invalid_argument("no condition: " + text);
  const std::size_t length = text.compare(start, 2, "!=") == 0 ? 2 : 1;
  Condition condition = {text.substr(0, start), text.substr(start, length),
                         text.substr(start + length)};
  if (condition.comparison == "!") throw std::invalid_argument("no condition: " + text);
  return condition;
}

bool meets_all(const Fields& fields, const std::vector<Condition>& conditions) {
  return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [&](const auto& f) { return f.first == condition.key; });
    if (field == fields.end()) throw std::invalid_argument("no such field: " + condition.key);
    return meets(field->second, condition);
  });
}

}  // namespace darkling::test
