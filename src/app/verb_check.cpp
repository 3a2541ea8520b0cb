// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/open_source.h"
#include "app/verb.h"
#include "base/text_file.h"
#include "io/config.h"
#include "io/memory_table.h"
#include "platform/clocks.h"
#include "vo/check_limits.h"
#include "vo/limits.h"
#include "vo/odometry.h"

namespace darkling {

namespace {

// What was typed.
struct CheckWords {
  std::string source;
  std::string size;
  std::string config_path;
  std::vector<std::string> settings;
  std::string width;
  bool is_memory_wanted = false;
};

// What is checked together, and what it was found to be.
struct Checked {
  OdometryConfig config;
  int width_px = 0;  // thumbnail
  int height_px = 0;
  std::string calibration = "not checked: no SOURCE is given";
};

constexpr double kMiB = 1024.0 * 1024.0;

Result<Config> read_config(const CheckWords& words) {
  std::vector<ConfigSetting> settings;
  for (const std::string& text : words.settings) settings.push_back({"--set", text});
  if (!words.width.empty()) settings.push_back({"--width", "width_px=" + words.width});
  return load_config(words.config_path, settings);
}

// The size of the thumbnail that --size names.
Result<void> take_size(const std::string& text, Checked& checked) {
  const std::vector<std::string_view> sides = split(text, 'x');
  const auto width = sides.size() == 2 ? parse_number<int>(sides[0]) : std::nullopt;
  const auto height = sides.size() == 2 ? parse_number<int>(sides[1]) : std::nullopt;
  if (!width || !height) {
    return failure(ExitCode::kUsage,
                   "--size: found '" + text + "', WIDTHxHEIGHT is needed, as 320x240");
  }
  checked.width_px = *width;
  checked.height_px = *height;
  return {};
}

// The thumbnail that the configured width gives of 4:3 images.
Result<void> take_configured_width(Checked& checked) {
  if (checked.config.width_px == 0) {
    return failure(ExitCode::kUsage,
                   "width_px is 0, the source's width: give a SOURCE, or the thumbnail's --size");
  }
  checked.width_px = checked.config.width_px;
  checked.height_px = (checked.width_px * 3 + 2) / 4;
  return {};
}

// Opens the source and makes an odometry for it, as a replay would before its first frame.
Result<void> take_source(const std::string& source, Checked& checked) {
  const auto recording = open_source(source, {});
  if (!recording) return tl::unexpected(recording.error());
  const auto odometry =
      Odometry::create(checked.config, recording->rig, KernelTable(), read_monotonic_clock);
  if (!odometry) return tl::unexpected(odometry.error());
  checked.width_px = (*odometry)->rig().width;
  checked.height_px = (*odometry)->rig().height;
  checked.calibration =
      "ok: " + (recording->calibration_path.empty() ? recording->kind + " rig"
                                                    : recording->calibration_path);
  return {};
}

Result<Checked> check_all(const CheckWords& words) {
  const auto config = read_config(words);
  if (!config) return tl::unexpected(config.error());
  Checked checked;
  checked.config = config->odometry;
  const Result<void> taken = !words.source.empty() ? take_source(words.source, checked)
                             : !words.size.empty() ? take_size(words.size, checked)
                                                   : take_configured_width(checked);
  if (!taken) return tl::unexpected(taken.error());
  const auto limits = check_limits(checked.config, checked.width_px, checked.height_px);
  if (!limits) return tl::unexpected(limits.error());
  return checked;
}

void print_row(const char* name, const std::string& found) {
  std::printf("  %-14s %s\n", name, found.c_str());
}

Result<int> run(const CheckWords& words) {
  if (!words.size.empty() && !(words.source.empty() && words.width.empty())) {
    return failure(ExitCode::kUsage,
                   "--size is the thumbnail's: it goes with neither a SOURCE "
                   "nor --width");
  }
  const auto checked = check_all(words);
  if (!checked) return tl::unexpected(checked.error());
  const int width_px = checked->width_px;
  const int height_px = checked->height_px;
  const MemoryMap map = map_memory(checked->config, width_px, height_px);
  char memory[128];
  std::snprintf(memory, sizeof(memory), "ok: %.2f of %.2f MiB%s",
                static_cast<double>(map.total_bytes()) / kMiB,
                static_cast<double>(memory_budget_bytes(width_px, height_px)) / kMiB,
                words.is_memory_wanted ? ", as follows" : "; --memory lists every buffer");
  print_row("configuration", "ok: " + (words.config_path.empty() ? "defaults" : words.config_path));
  print_row("calibration", checked->calibration);
  print_row("limits", "ok: thumbnail " + std::to_string(width_px) + " x " +
                          std::to_string(height_px) + " px, " +
                          std::to_string(checked->config.points_per_level) + " points a level");
  print_row("memory", memory);
  if (words.is_memory_wanted) {
    std::printf("\n%s", format_memory_table(map, width_px, height_px).c_str());
  }
  return 0;
}

constexpr const char* kMore =
    "One row says what was found of each thing that can be wrong before a start; the first that "
    "is\n"
    "wrong ends the check with its message and exit code. With a SOURCE, its calibration is "
    "checked\n"
    "too, and sizes are those of its thumbnail; without, they are those of 4:3 images.\n\n"
    "--memory lists every buffer that is claimed at start, the total and its budget, and how much\n"
    "stack a frame takes at most. Stages (written by, read by) are those of `stage_us` in the\n"
    "statistics of a replay.\n\n"
    "Examples:\n"
    "  darkling check --config rover.yaml\n"
    "  darkling check --memory --size 640x480\n"
    "  darkling check --memory ~/euroc/MH_01_easy --width 188\n";

}  // namespace

VerbAction declare_check(CLI::App& command) {
  auto words = std::make_shared<CheckWords>();
  command.add_option("SOURCE", words->source, "A recording, as `darkling replay` takes it")
      ->type_name("FOLDER|synthetic:SCENE");
  command.add_flag("--memory", words->is_memory_wanted, "List every buffer and its size");
  command.add_option("--size", words->size, "Of the thumbnail, in place of a SOURCE")
      ->type_name("WxH");
  command.add_option("--config", words->config_path, "Configuration file (YAML)")
      ->type_name("FILE");
  command.add_option("--set", words->settings, "One key of the configuration; repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  command.add_option("--width", words->width, "Thumbnail width, height follows; 0: the source's")
      ->type_name("PX");
  command.footer(kMore);
  return [words] { return run(*words); };
}

}  // namespace darkling
