// SPDX-License-Identifier: Apache-2.0
#include "app/top/top_json.h"

#include <nlohmann/json.hpp>

#include "app/service/health.h"

namespace darkling {

namespace {

using Json = nlohmann::ordered_json;

template <std::size_t N>
Json array_json(const double (&values)[N]) {
  return Json(std::vector<double>(values, values + N));
}

void put_state(Json& json, const status_t& s) {
  json["utime"] = s.utime;
  json["mono_ns"] = s.mono_ns;
  json["state"] = s.state;
  json["state_name"] = name_of(state_from_message(s.state));
  json["reasons"] = s.reasons;
  json["reason_names"] = names_of_reasons(static_cast<std::uint32_t>(s.reasons));
  json["reset_counter"] = s.reset_counter;
  json["uptime_s"] = s.uptime_s;
}

void put_counts(Json& json, const status_t& s) {
  json["frames_in"] = s.frames_in;
  json["frames_tracked"] = s.frames_tracked;
  json["frames_lost"] = s.frames_lost;
  json["frames_skipped"] = s.frames_skipped;
  json["frames_unpaired"] = s.frames_unpaired;
  json["frames_bad"] = s.frames_bad;
  json["device_dropped"] = s.device_dropped;
  json["device_errors"] = s.device_errors;
  json["publish_failures"] = s.publish_failures;
  json["deadline_misses"] = s.deadline_misses;
  json["refinement_overruns"] = s.refinement_overruns;
  json["wall_clock_steps"] = s.wall_clock_steps;
  json["rate_in_hz"] = s.rate_in_hz;
  json["rate_out_hz"] = s.rate_out_hz;
  json["latency_p50_ms"] = s.latency_p50_ms;
  json["latency_max_ms"] = s.latency_max_ms;
}

void put_rest(Json& json, const status_t& s) {
  json["exposure_ms"] = s.exposure_ms;
  json["gain"] = s.gain;
  json["skew_ms"] = s.skew_ms;
  json["stamp_source"] = s.stamp_source;
  json["stamp_uncertainty_ms"] = s.stamp_uncertainty_ms;
  json["arena_bytes"] = s.arena_bytes;
  json["rss_bytes"] = s.rss_bytes;
  json["heap_calls"] = s.heap_calls;
  json["is_recording"] = s.is_recording != 0;
  json["recorded_frames"] = s.recorded_frames;
  json["record_drops"] = s.record_drops;
  json["width"] = s.width;
  json["height"] = s.height;
  json["kernels"] = s.kernels;
  json["version"] = s.version;
  json["camera"] = s.camera;
}

// What pose and update have alike.
template <class Message>
Json frame_json(const Message& m) {
  Json json;
  json["utime"] = m.utime;
  json["mono_ns"] = m.mono_ns;
  json["seq"] = m.seq;
  json["reset_counter"] = m.reset_counter;
  json["status"] = m.status;
  json["quality"] = m.quality;
  json["translation"] = array_json(m.translation);
  json["rotation"] = array_json(m.rotation);
  json["covariance"] = array_json(m.covariance);
  return json;
}

Json pose_json(const pose_t& pose) {
  Json json = frame_json(pose);
  json["velocity"] = array_json(pose.velocity);
  json["angular_velocity"] = array_json(pose.angular_velocity);
  return json;
}

Json update_json(const update_t& update) {
  Json json = frame_json(update);
  json["prev_utime"] = update.prev_utime;
  json["reasons"] = update.reasons;
  json["reason_names"] = names_of_reasons(static_cast<std::uint32_t>(update.reasons));
  return json;
}

}  // namespace

std::string format_heard_json(const Heard& heard) {
  Json json;
  put_state(json, *heard.status);
  put_counts(json, *heard.status);
  put_rest(json, *heard.status);
  json["pose"] = heard.pose ? pose_json(*heard.pose) : Json(nullptr);
  json["update"] = heard.update ? update_json(*heard.update) : Json(nullptr);
  json["malformed_messages"] = heard.malformed;
  // A camera's name need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace darkling
