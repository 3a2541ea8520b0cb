// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/injected_recording.h"
#include "app/verb.h"
#include "app/verb_convert.h"

namespace darkling {

namespace {

// What was typed.
struct ConvertWords {
  std::string source;
  std::string output;
  std::string format;
  std::string frames;
  std::vector<std::string> injections;
  std::int64_t stride = 1;
  bool is_forced = false;
};

// The dataset's layout, or nothing for a frame log.
Result<std::optional<DatasetLayout>> understand_format(const ConvertWords& words) {
  const bool is_log_name = std::string_view(words.output).ends_with(".lcmlog");
  if (words.format == "lcmlog" || (words.format.empty() && is_log_name)) return std::nullopt;
  if (words.format == "kitti") return DatasetLayout::kKitti;
  if (words.format == "euroc") return DatasetLayout::kEuroc;
  if (words.format.empty()) {
    return failure(ExitCode::kUsage, words.output +
                                         ": is no *.lcmlog; say what the folder is to be with "
                                         "--format kitti or --format euroc");
  }
  return failure(ExitCode::kUsage,
                 "--format: found '" + words.format + "', allowed are lcmlog, kitti, euroc");
}

Result<int> run(const ConvertWords& words) {
  const auto layout = understand_format(words);
  if (!layout) return tl::unexpected(layout.error());
  OpenOptions frames;
  if (words.stride < 1) {
    return failure(ExitCode::kUsage,
                   "--stride: found " + std::to_string(words.stride) + ", allowed is 1 and more");
  }
  frames.stride = words.stride;
  if (!words.frames.empty()) {
    const auto range = parse_frame_range(words.frames, frames);
    if (!range) return tl::unexpected(range.error());
    frames = *range;
  }
  auto injections = parse_injections(words.injections);
  if (!injections) return tl::unexpected(injections.error());
  return run_convert({.source = words.source,
                      .frames = frames,
                      .injections = std::move(*injections),
                      .output = words.output,
                      .layout = *layout,
                      .is_forced = words.is_forced});
}

constexpr const char* kMore =
    "SOURCE is anything that `darkling replay` plays. A frame log keeps all that matters to the\n"
    "odometry, to the bit: replaying it gives the same trajectory. Bad pairs stay gaps; from a\n"
    "log, commands and hints that the service obeyed go along into another log. Truth goes\n"
    "along; into a folder only where a pose is known for the very frame, and into a KITTI folder,\n"
    "which holds rectified images only, where one is known for every frame.\n"
    "The same source gives the same bytes. An interrupted run leaves a shorter recording.\n"
    "--inject is as of `darkling replay`, which lists all there is: replaying OUT then gives what\n"
    "replaying SOURCE with the same injections gives.\n\n"
    "Examples:\n"
    "  darkling convert ~/euroc/MH_01_easy mh01.lcmlog\n"
    "  darkling convert run.lcmlog out/run --format euroc --frames 100:200\n"
    "  darkling convert ~/kitti/06 dusk.lcmlog --inject electrons=5\n"
    "  darkling convert synthetic:mine,frames=200,seed=1 mine.lcmlog\n";

}  // namespace

VerbAction declare_convert(CLI::App& command) {
  auto words = std::make_shared<ConvertWords>();
  command.add_option("SOURCE", words->source, "The recording to read")
      ->required()
      ->type_name("FOLDER|FILE.lcmlog|synthetic:SCENE");
  command.add_option("OUT", words->output, "Where to; absent, or an empty folder")
      ->required()
      ->type_name("FILE.lcmlog|FOLDER");
  command.add_option("--format", words->format, "Of OUT; default lcmlog where its name says so")
      ->type_name("lcmlog|kitti|euroc");
  command.add_option("--frames", words->frames, "Only frames A up to but without B, from 0")
      ->type_name("A:B");
  command.add_option("--stride", words->stride, "Only every N-th frame")->type_name("N");
  declare_inject_option(command, words->injections);
  command.add_flag("--force", words->is_forced, "Write over an earlier recording at OUT");
  command.footer(kMore);
  return [words] { return run(*words); };
}

}  // namespace darkling
