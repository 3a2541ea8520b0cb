// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "io/run_report.h"

namespace darkling {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

void put_evaluation(Json& json, const std::optional<Evaluation>& evaluation) {
  const auto figure = [&](auto Evaluation::*member) {
    return evaluation ? Json((*evaluation).*member) : Json(nullptr);
  };
  const auto drift = [&](auto Evaluation::*member) {
    return evaluation ? json_or_null((*evaluation).*member) : Json(nullptr);
  };
  json["ate_rmse_m"] = figure(&Evaluation::ate_rmse_m);
  json["drift_percent"] = drift(&Evaluation::drift_percent);
  json["drift_deg_per_m"] = drift(&Evaluation::drift_deg_per_m);
  json["rpe_rmse_m"] = figure(&Evaluation::rpe_rmse_m);
  json["rpe_rmse_deg"] = figure(&Evaluation::rpe_rmse_deg);
  const auto nees = [&](std::optional<Nees> Evaluation::*member) {
    const std::optional<Nees> value = evaluation ? (*evaluation).*member : std::nullopt;
    return value ? Json(value->mean) : Json(nullptr);
  };
  json["nees_motion"] = nees(&Evaluation::nees_motion);
  json["nees_pose"] = nees(&Evaluation::nees_pose);
  const bool is_confidence_known = evaluation && evaluation->confidence;
  const Confidence confidence = is_confidence_known ? *evaluation->confidence : Confidence();
  json["confident_frames"] = is_confidence_known ? Json(confidence.frames) : Json(nullptr);
  json["confidently_wrong"] = is_confidence_known ? Json(confidence.wrong.size()) : Json(nullptr);
  json["confidently_wrong_frames"] = confidence.wrong;
  json["end_error_m"] = figure(&Evaluation::end_error_m);
  json["end_error_deg"] = figure(&Evaluation::end_error_deg);
  json["truth_path_m"] = figure(&Evaluation::path_m);
  json["truth_poses"] = figure(&Evaluation::matched_poses);
}

// "lost" also of frames without a usable pair, whose reason is "dropped".
const char* state_name(TrackStatus status) {
  switch (status) {
    case TrackStatus::kValid:
      return "valid";
    case TrackStatus::kDegraded:
      return "degraded";
    case TrackStatus::kUnknown:
    case TrackStatus::kLost:
      break;
  }
  return "lost";
}

Json states_json(const std::vector<StateSpan>& spans) {
  Json states = Json::array();
  for (const StateSpan& span : spans) {
    Json reasons = Json::array();
    for (int bit = 0; bit < kReasonCount; ++bit) {
      if ((span.reasons >> bit & 1u) != 0) reasons.push_back(kReasonNames[bit]);
    }
    states.push_back({{"frames", span.frames},
                      {"first", span.first},
                      {"state", state_name(span.status)},
                      {"reasons", reasons},
                      {"resets", span.resets}});
  }
  return states;
}

void put_counts(Json& json, const Statistics& statistics) {
  json["frames"] = statistics.frames;
  json["keyframes"] = statistics.keyframes;
  json["tracked_frames"] = statistics.tracked_frames;
  json["degraded_frames"] = statistics.degraded_frames;
  json["lost_frames"] = statistics.lost_frames;
  json["bad_frames"] = statistics.bad_frames;
  json["resets"] = statistics.resets;
  json["states"] = states_json(statistics.states);
  json["distance_m"] = statistics.distance_m;
  for (int bit = 0; bit < kReasonCount; ++bit) {
    json["reasons"][kReasonNames[bit]] = statistics.reasons[bit];
  }
  for (int outcome = 1; outcome < kRefinementCount; ++outcome) {
    json["refinements"][kRefinementNames[outcome]] = statistics.refinements[outcome];
  }
}

Json percentiles_json(const std::optional<Percentiles>& p) {
  if (!p) return nullptr;
  return Json{{"p50", p->p50}, {"p90", p->p90}, {"p99", p->p99}, {"max", p->max}};
}

// A stage that never ran has no entry.
Json stages_json(const Statistics& statistics) {
  Json stages = Json::object();
  for (int stage = 0; stage < kStageCount; ++stage) {
    if (const auto& p = statistics.stage_us[stage]) {
      stages[kStageNames[stage]] = {{"p50", p->p50}, {"p99", p->p99}};
    }
  }
  return stages;
}

}  // namespace

std::string format_statistics_json(const RunReport& report) {
  Json json;
  json["source"] = report.source;
  json["interrupted"] = report.was_interrupted;
  put_counts(json, report.statistics);
  json["source_faults"] = {{"unreadable", report.faults.unreadable},
                           {"wrong_size", report.faults.wrong_size},
                           {"unpaired", report.faults.unpaired},
                           {"stamps_not_increasing", report.faults.stamps_not_increasing}};
  put_evaluation(json, report.evaluation);
  json["frame_ms"] = percentiles_json(report.statistics.frame_ms);
  json["frame_period_ms"] = json_or_null(report.statistics.frame_period_ms);
  json["stage_us"] = stages_json(report.statistics);
  json["iterations"] = percentiles_json(report.statistics.iterations);
  json["arena_bytes"] = report.arena_bytes;
  json["heap_calls_after_start"] = json_or_null(report.heap_calls_after_start);
  json["peak_rss_bytes"] = json_or_null(report.peak_rss_bytes);
  json["kernels"] = report.kernels;
  json["width"] = report.width_px;
  json["height"] = report.height_px;
  json["trajectory_sha256"] = report.trajectory_sha256;
  // A source's name need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string format_evaluation_json(const Evaluation& evaluation) {
  Json json;
  put_evaluation(json, evaluation);
  return json.dump(2) + '\n';
}

}  // namespace darkling
