// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "app/injected_recording.h"
#include "app/replay.h"
#include "app/service/config_words.h"
#include "app/verb.h"
#include "base/nearest.h"

namespace darkling {

namespace {

// What was typed.
struct ReplayWords {
  std::string source;
  ConfigWords config;
  std::string width;
  std::string trajectory_path;
  std::string format = "kitti";
  std::string truth_path;
  std::vector<double> truth_noise = {0.0, 0.0};  // as TruthNoise
  std::string stats_path;
  std::string log_path;
  std::string pace = "fast";
  std::string kernels = "auto";
  std::string frames;
  std::vector<std::string> injections;
  std::int64_t stride = 1;
  bool is_config_wanted = false;
};

// Which of the two `names` was typed for `option`.
Result<bool> is_first(const char* option, const std::string& word,
                      const std::array<std::string_view, 2>& names) {
  if (word == names[0] || word == names[1]) return word == names[0];
  return failure(ExitCode::kUsage,
                 std::string(option) + ": found '" + word + "', allowed are " + join_names(names));
}

Result<ReplayOptions> understand(const ReplayWords& words) {
  const auto is_tum = is_first("--format", words.format, {"tum", "kitti"});
  if (!is_tum) return tl::unexpected(is_tum.error());
  const auto is_fast = is_first("--pace", words.pace, {"fast", "recorded"});
  if (!is_fast) return tl::unexpected(is_fast.error());
  if (words.stride < 1) {
    return failure(ExitCode::kUsage,
                   "--stride: found " + std::to_string(words.stride) + ", allowed is 1 and more");
  }
  OpenOptions frames;
  frames.stride = words.stride;
  if (!words.frames.empty()) {
    const auto range = parse_frame_range(words.frames, frames);
    if (!range) return tl::unexpected(range.error());
    frames = *range;
  }
  auto injections = parse_injections(words.injections);
  if (!injections) return tl::unexpected(injections.error());
  std::vector<ConfigSetting> settings = words.config.settings();
  if (!words.width.empty()) settings.push_back({"--width", "width_px=" + words.width});
  return ReplayOptions{
      .source = words.source,
      .frames = frames,
      .injections = std::move(*injections),
      .config_path = words.config.path,
      .settings = settings,
      .kernels = words.kernels,
      .truth_path = words.truth_path,
      .truth_noise = {.share = words.truth_noise[0], .angle_deg = words.truth_noise[1]},
      .pace = *is_fast ? Pace::kFast : Pace::kRecorded,
      .outputs = {.trajectory_path = words.trajectory_path,
                  .trajectory_format = *is_tum ? TrajectoryFormat::kTum : TrajectoryFormat::kKitti,
                  .stats_path = words.stats_path},
      .log_path = words.log_path};
}

Result<int> run(const ReplayWords& words) {
  const auto options = understand(words);
  if (!options) return tl::unexpected(options.error());
  if (words.is_config_wanted) {
    const auto config = load_config(options->config_path, options->settings);
    if (!config) return tl::unexpected(config.error());
    std::fputs(format_config(*config).c_str(), stdout);
    return 0;
  }
  if (words.source.empty()) {
    return failure(ExitCode::kUsage, "SOURCE is missing\nTry: darkling replay --help");
  }
  return replay(*options);
}

constexpr const char* kMore =
    "SOURCE is recognised by what it holds:\n"
    "  a KITTI odometry folder   image_0 image_1 calib.txt times.txt [poses.txt]\n"
    "  an EuRoC folder           mav0/camN/data.csv with sensor.yaml files, or a Kalibr\n"
    "                            camchain.yaml beside mav0; truth in\n"
    "                            mav0/state_groundtruth_estimate0/data.csv or groundtruth.tum\n"
    "  a frame log               NAME.lcmlog, as `darkling convert` writes it\n"
    "  synthetic:SCENE[,key=value...]  rendered on the fly; `darkling render --help` lists them\n\n"
    "Trajectories: `kitti` rows are T_world_left of the rectified left camera, the first the\n"
    "identity, one for every input frame, bad ones included. `tum` rows are T_world_body with the\n"
    "source's own time stamps. The same input gives the same bytes, whatever the kernels.\n\n"
    "NEES tells whether covariances keep what they promise: the mean of e' inverse(C) e / 6 of\n"
    "errors e with covariance C, 1 where they are right, above where they promise too much. The\n"
    "truth counts as exact unless --truth-noise says otherwise.\n\n"
    "--log writes a frame log of what the run saw, injected faults included, with VO_UPDATE and\n"
    "VO_POSE behind every frame and VO_STATUS twice a second, as darklingd would publish them. It\n"
    "replays to the same poses. Nothing is written over: FILE-2.lcmlog is next where FILE is "
    "taken.\n\n"
    "A run that lost track on the way is done all the same and exits 0: the table says so.\n\n";

constexpr const char* kExamples =
    "\nExamples:\n"
    "  darkling replay ~/kitti/06 --width 310 --trajectory 06.txt --stats 06.json\n"
    "  darkling replay ~/euroc/MH_01_easy --trajectory mh01.tum --format tum\n"
    "  darkling replay synthetic:mine,frames=200,seed=1\n"
    "  darkling replay ~/kitti/06 --inject electrons=5 --inject blackout@100:105\n"
    "  darkling replay synthetic:mine --log mine.lcmlog && darkling replay mine.lcmlog\n"
    "  darkling replay --print-config > rover.yaml\n";

void declare_input(CLI::App& command, ReplayWords& words) {
  command.add_option("SOURCE", words.source, "The recording to play")
      ->type_name("FOLDER|FILE.lcmlog|synthetic:SCENE");
  declare_config_options(command, words.config);
  command.add_option("--width", words.width, "Thumbnail width, height follows; 0: the source's")
      ->type_name("PX");
  command.add_option("--frames", words.frames, "Only frames A up to but without B, from 0")
      ->type_name("A:B");
  command.add_option("--stride", words.stride, "Only every N-th frame")->type_name("N");
  declare_inject_option(command, words.injections);
  command.add_option("--pace", words.pace, "As fast as it goes, or as it was recorded")
      ->type_name("fast|recorded");
  command.add_option("--kernels", words.kernels, "Instruction set to compute with")
      ->type_name("ref|sse41|avx2|neon|auto");
}

void declare_output(CLI::App& command, ReplayWords& words) {
  command.add_option("--trajectory", words.trajectory_path, "Write the poses here")
      ->type_name("FILE");
  command.add_option("--format", words.format, "Of the trajectory; default kitti")
      ->type_name("tum|kitti");
  command
      .add_option("--truth", words.truth_path, "Compare with this; default: the recording's own")
      ->type_name("FILE");
  command
      .add_option("--truth-noise", words.truth_noise,
                  "Of true motions, for NEES: sigma per length or angle, besides in deg")
      ->type_name("SHARE,DEG")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::NonNegativeNumber);
  command.add_option("--stats", words.stats_path, "Write statistics here, as JSON")
      ->type_name("FILE");
  command.add_option("--log", words.log_path, "Write frames and what is published of them here")
      ->type_name("FILE.lcmlog");
  command.add_flag("--print-config", words.is_config_wanted,
                   "Print the configuration that would be used, and stop");
}

}  // namespace

VerbAction declare_replay(CLI::App& command) {
  auto words = std::make_shared<ReplayWords>();
  declare_input(command, *words);
  declare_output(command, *words);
  command.footer(std::string(kMore) + describe_inject_option() + kExamples);
  return [words] { return run(*words); };
}

}  // namespace darkling
