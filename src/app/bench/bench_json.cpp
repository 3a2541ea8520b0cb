// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "app/bench/bench_report.h"

namespace darkling {

namespace {

using Json = nlohmann::ordered_json;

Json cost_json(const KernelCost& cost) {
  return {{"bytes", cost.bytes},
          {"byte_operations", cost.byte_operations},
          {"float_operations", cost.float_operations}};
}

Json variant_json(const VariantTiming& v) {
  return {{"kernels", v.kernels},
          {"ns_per_unit", v.time.median_ns},
          {"spread", v.time.spread},
          {"gain_over_ref", v.gain},
          {"memory_share", v.least.memory_ns / v.time.median_ns},
          {"arithmetic_share", v.least.arithmetic_ns / v.time.median_ns},
          {"bound_ns", v.least.bound_ns()},
          {"ratio", v.least.bound_ns() / v.time.median_ns},
          {"nearer_to", v.least.is_memory_bound() ? "memory" : "arithmetic"}};
}

Json kernels_json(const KernelReport& report) {
  Json json = {{"width", report.width},
               {"height", report.height},
               {"points", report.points},
               {"samples", report.rounds}};
  for (const PeakSpeed& peak : report.peaks) {
    json["peaks"].push_back({{"kernels", peak.kernels},
                             {"byte_operations_per_ns", peak.byte_operations_per_ns},
                             {"float_operations_per_ns", peak.float_operations_per_ns}});
  }
  for (const KernelTimings& k : report.kernels) {
    Json kernel = {{"kernel", name_of(k.kernel).name},
                   {"unit", name_of(k.kernel).unit},
                   {"units", k.units},
                   {"cost_per_unit", cost_json(k.cost)},
                   {"working_set_bytes", k.working_set_bytes},
                   {"copy_bytes_per_ns", k.copy_bytes_per_ns}};
    for (const VariantTiming& v : k.variants) kernel["variants"].push_back(variant_json(v));
    json["kernels"].push_back(std::move(kernel));
  }
  return json;
}

Json percentiles_json(const std::optional<Percentiles>& p) {
  if (!p) return nullptr;
  return {{"p50", p->p50}, {"p90", p->p90}, {"p99", p->p99}, {"max", p->max}};
}

Json frame_cost_json(const FrameCost& cost) {
  Json json = {{"frames", cost.frames}};
  if (cost.frames == 0) return json;
  KernelCost total;
  for (int k = 0; k < kKernelCount; ++k) {
    const KernelWork& work = cost.work[k];
    total.bytes += work.total.bytes;
    total.byte_operations += work.total.byte_operations;
    total.float_operations += work.total.float_operations;
    json["units"][kKernelNames[k].name] = work.units;
  }
  json["work"] = cost_json(total);
  json["memory_us"] = 1e-3 * cost.least.memory_ns;
  json["arithmetic_us"] = 1e-3 * cost.least.arithmetic_ns;
  json["bound_us"] = 1e-3 * cost.least.bound_ns();
  json["kernels_us"] = cost.kernels_us;
  json["frame_us"] = cost.measured_us;
  json["ratio"] = 1e-3 * cost.least.bound_ns() / cost.measured_us;
  return json;
}

Json stages_json(const StageReport& report) {
  Json json = {{"source", report.source},
               {"kernels", report.kernels},
               {"width", report.width},
               {"height", report.height},
               {"points_per_level", report.points_per_level},
               {"plays", report.repeats}};
  for (const StageTimes& stage : report.stages) {
    json["stage_us"][stage.name] = {{"all", percentiles_json(stage.all)},
                                    {"keyframes", percentiles_json(stage.keyframes)},
                                    {"others", percentiles_json(stage.others)}};
  }
  json["rectify_share"] = report.rectify_share;
  json["keyframes"] = frame_cost_json(report.keyframes);
  json["others"] = frame_cost_json(report.others);
  return json;
}

Json series_json(const SweepSeries& series) {
  Json json;
  for (const SweepPoint& p : series.points) {
    json["settings"].push_back({{"width", p.width},
                                {"height", p.height},
                                {"points_per_level", p.points_per_level},
                                {"keyframe_us", p.keyframe_us},
                                {"other_us", p.other_us},
                                {"keyframe_ns_per_pixel", 1e3 * p.keyframe_us / p.pixels()},
                                {"other_ns_per_pixel", 1e3 * p.other_us / p.pixels()}});
  }
  const auto exponent = [](const std::optional<PowerLaw>& law) {
    return law ? Json(law->exponent) : Json(nullptr);
  };
  json["keyframe_exponent"] = exponent(series.keyframes);
  json["other_exponent"] = exponent(series.others);
  return json;
}

Json sweep_json(const SweepReport& report) {
  return {{"source", report.source},
          {"kernels", report.kernels},
          {"frames", report.frames},
          {"plays", report.repeats},
          {"by_width", series_json(report.by_width)},
          {"by_points", series_json(report.by_points)}};
}

}  // namespace

std::string format_bench_json(const BenchReport& report) {
  Json json = Json::object();
  if (report.kernels) json["kernels"] = kernels_json(*report.kernels);
  if (report.stages) json["stages"] = stages_json(*report.stages);
  if (report.sweep) json["sweep"] = sweep_json(*report.sweep);
  // A source's name need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace darkling
