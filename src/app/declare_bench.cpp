// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/verb.h"
#include "app/verb_bench.h"
#include "base/text_file.h"
#include "io/config.h"
#include "vo/limits.h"

namespace darkling {

namespace {

constexpr const char* kStageSource = "synthetic:corridor,frames=60";
// A sweep goes up to thumbnails 640 px wide.
constexpr const char* kSweepSource = "synthetic:corridor,frames=20,width=640";
constexpr int kMaxRenderedWidth = 960;    // px; the cameras of what is rendered are twice as wide
constexpr const char* kFrames = "0:200";  // more are no news, and memory

// What was typed.
struct BenchWords {
  std::string size;
  std::string kernels;
  std::string source;
  std::string frames = kFrames;
  std::string width;
  std::string points;
  int repeats = 0;
  bool is_sweep = false;
  bool is_json = false;
};

Result<void> understand_size(const std::string& text, BenchOptions& options) {
  if (text.empty()) return {};
  if (!options.has_kernels) {
    return failure(ExitCode::kUsage,
                   "--size: is for the kernels by themselves; a sweep takes --width");
  }
  const auto sides = split(text, 'x');
  const auto width = sides.size() == 2 ? parse_number<int>(sides[0]) : std::nullopt;
  const auto height = sides.size() == 2 ? parse_number<int>(sides[1]) : std::nullopt;
  const bool is_allowed = width && height && *width >= kMinWidth && *width <= kMaxRenderedWidth &&
                          4 * *height >= *width && 2 * *height <= 3 * *width;
  if (!is_allowed) {
    return failure(ExitCode::kUsage, "--size: found '" + text + "', allowed is WxH with " +
                                         std::to_string(kMinWidth) + " to " +
                                         std::to_string(kMaxRenderedWidth) +
                                         " px of width, and a quarter to one and a half times as "
                                         "much height, as 320x240");
  }
  options.width = *width;
  options.height = *height;
  return {};
}

Result<BenchOptions> understand(const BenchWords& words) {
  BenchOptions options;
  // What an option speaks of is wanted; where none does, both are.
  options.has_kernels = !words.is_sweep && (!words.size.empty() || words.source.empty());
  options.has_stages = !words.is_sweep && (!words.source.empty() || words.size.empty());
  options.has_sweep = words.is_sweep;
  if (auto sized = understand_size(words.size, options); !sized) {
    return tl::unexpected(sized.error());
  }
  std::vector<ConfigSetting> settings;
  if (!words.width.empty()) settings.push_back({"--width", "width_px=" + words.width});
  if (!words.points.empty()) settings.push_back({"--points", "points_per_level=" + words.points});
  const auto config = load_config("", settings);
  if (!config) return tl::unexpected(config.error());
  options.config = config->odometry;
  const auto range = parse_frame_range(words.frames, {});
  if (!range) return tl::unexpected(range.error());
  if (words.repeats < 0) {
    return failure(ExitCode::kUsage,
                   "--repeat: found " + std::to_string(words.repeats) + ", allowed is 1 and more");
  }
  options.frames = *range;
  options.source = words.source;
  if (words.source.empty()) options.source = words.is_sweep ? kSweepSource : kStageSource;
  options.kernels = words.kernels;
  options.repeats = words.repeats;
  options.is_json = words.is_json;
  return options;
}

Result<int> run(const BenchWords& words) {
  const auto options = understand(words);
  if (!options) return tl::unexpected(options.error());
  return run_bench(*options);
}

constexpr const char* kMore =
    "Three things can be measured:\n"
    "  kernels   every kernel by itself with every instruction set of this processor, against "
    "what\n"
    "            the machine can do: copying as much memory as the kernel goes through (so, in "
    "the\n"
    "            level of the cache it lives in), and arithmetic on registers\n"
    "  stages    whole frames of SOURCE, held in memory: p50 and p99 of every stage, keyframes\n"
    "            apart, and the frame against what its kernels must take at least\n"
    "  sweep     how the time of a frame grows with width (96 to 640 px) and points (250 to 4000)\n"
    "With --size: kernels. With --source: stages. With --sweep: the sweep. Else: kernels, "
    "stages.\n\n"
    "A unit is what a kernel is called for: an output pixel, a point of the template, a candidate\n"
    "of the stereo search. Bytes and operations are counted from what the kernel promises, not\n"
    "measured; a byte op is arithmetic on one byte, so a 16-bit sum counts two.\n"
    "Times are processor time, medians of samples that are taken in turns, so a busy machine is\n"
    "bearable; where p90 is above +20 %, wait for a quieter one.\n\n"
    "Examples:\n"
    "  darkling bench                                  all of it, some ten seconds\n"
    "  darkling bench --size 640x480 --kernels avx2    one instruction set, larger images\n"
    "  darkling bench --source ~/euroc/MH_01_easy --width 188\n"
    "  darkling bench --sweep --json > sweep.json\n";

}  // namespace

VerbAction declare_bench(CLI::App& command) {
  auto words = std::make_shared<BenchWords>();
  command.add_option("--size", words->size, "Thumbnail that the kernels work on; default 320x240")
      ->type_name("WxH");
  command
      .add_option("--kernels", words->kernels, "Only this instruction set, and ref to compare it")
      ->type_name("ref|sse41|avx2|neon|auto");
  command.add_option("--source", words->source, "Frames to play, as replay takes them")
      ->type_name("FOLDER|synthetic:SCENE");
  command
      .add_option("--frames", words->frames,
                  "Of the source, A up to but without B; default " + std::string(kFrames))
      ->type_name("A:B");
  command.add_option("--width", words->width, "Thumbnail width of frames; 0: the source's")
      ->type_name("PX");
  command.add_option("--points", words->points, "Template points at most, each level")
      ->type_name("N");
  command
      .add_option("--repeat", words->repeats,
                  "Samples of each kernel (default 21), plays of each frame (10; sweep: 5)")
      ->type_name("N");
  command.add_flag("--sweep", words->is_sweep, "Cost against width and against points");
  command.add_flag("--json", words->is_json, "Print JSON instead of tables");
  command.footer(kMore);
  return [words] { return run(*words); };
}

}  // namespace darkling
