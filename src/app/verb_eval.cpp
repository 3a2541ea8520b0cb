// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "app/verb.h"
#include "io/run_report.h"
#include "io/trajectory.h"

namespace darkling {

namespace {

struct EvalOptions {
  std::string truth_path;
  std::string estimate_path;
  bool is_json = false;
};

Result<int> compare(const EvalOptions& options) {
  const auto truth = read_trajectory(options.truth_path);
  if (!truth) return tl::unexpected(truth.error());
  const auto estimate = read_trajectory(options.estimate_path);
  if (!estimate) return tl::unexpected(estimate.error());
  const auto evaluation = evaluate(*truth, *estimate);
  if (!evaluation) {
    return failure(evaluation.error().code, options.truth_path + " and " + options.estimate_path +
                                                ": " + evaluation.error().message);
  }
  const std::string text =
      options.is_json ? format_evaluation_json(*evaluation) : format_evaluation_table(*evaluation);
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace

VerbAction declare_eval(CLI::App& command) {
  auto options = std::make_shared<EvalOptions>();
  command.add_option("TRUTH", options->truth_path, "The true trajectory")
      ->required()
      ->type_name("FILE");
  command.add_option("ESTIMATE", options->estimate_path, "The trajectory to judge")
      ->required()
      ->type_name("FILE");
  command.add_flag("--json", options->is_json, "Print JSON instead of a table");
  command.footer(
      "Files are recognised by their columns: KITTI (12 numbers a row, compared row by row), TUM\n"
      "(stamp tx ty tz qx qy qz qw, compared to the nearest truth within 5 ms) and EuRoC's\n"
      "state_groundtruth_estimate0/data.csv. KITTI and the others cannot be mixed.\n\n"
      "drift  mean error of the motion over 100 … 800 m, from every start frame (KITTI odometry);\n"
      "       on paths under 100 m over 5, 10, 20, 30, 40, 50 m; none under 5 m\n"
      "ATE    RMS distance of positions after rigid alignment\n"
      "RPE    RMS error of the motion between consecutive poses\n\n"
      "Example:\n"
      "  darkling eval poses.txt estimate.txt\n");
  return [options] { return compare(*options); };
}

}  // namespace darkling
