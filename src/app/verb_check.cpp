// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/check_cameras.h"
#include "app/check_system.h"
#include "app/service/config_words.h"
#include "app/verb.h"
#include "base/image_size.h"
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
  ConfigWords config;
  std::string width;
  bool is_memory_wanted = false;
};

constexpr double kMiB = 1024.0 * 1024.0;

Result<Config> read_config(const CheckWords& words) {
  std::vector<ConfigSetting> settings = words.config.settings();
  if (!words.width.empty()) settings.push_back({"--width", "width_px=" + words.width});
  return load_config(words.config.path, settings);
}

// Of the thumbnail; nothing: not known.
using Thumbnail = std::optional<ImageSize>;

// The size that --size names.
Result<Thumbnail> parse_size(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::vector<std::string_view> sides = split(text, 'x');
  const auto width = sides.size() == 2 ? parse_number<int>(sides[0]) : std::nullopt;
  const auto height = sides.size() == 2 ? parse_number<int>(sides[1]) : std::nullopt;
  if (!width || !height) {
    return failure(ExitCode::kUsage,
                   "--size: found '" + text + "', WIDTHxHEIGHT is needed, as 320x240");
  }
  return ImageSize{.width = *width, .height = *height};
}

// What the rig gives at the configured width, else what the width gives of 4:3 images.
Thumbnail choose_thumbnail(const OdometryConfig& config, const std::optional<StereoRig>& rig) {
  if (rig) {
    const int width_px = config.width_px == 0 ? rig->left.width : config.width_px;
    return ImageSize{.width = width_px, .height = thumbnail_height(rig->left, width_px)};
  }
  if (config.width_px == 0) return std::nullopt;
  return ImageSize{.width = config.width_px, .height = (config.width_px * 3 + 2) / 4};
}

// Limits, and with a rig whether an odometry can be made for it, as before a first frame.
Result<void> check_thumbnail(const OdometryConfig& config, const std::optional<StereoRig>& rig,
                             ImageSize size) {
  const auto limits = check_limits(config, size.width, size.height);
  if (!limits || !rig) return limits;
  const auto odometry = Odometry::create(config, *rig, KernelTable(), read_monotonic_clock);
  if (!odometry) return tl::unexpected(odometry.error());
  return {};
}

// @return what the odometry claims; 0 when that cannot be told.
std::uint64_t add_memory(const OdometryConfig& config, const std::optional<StereoRig>& rig,
                         const Thumbnail& size, bool is_table_wanted, CheckRows& rows) {
  constexpr const char* kWhy = "the size of the thumbnail is not known";
  if (!size) {
    rows.not_checked("limits", kWhy);
    rows.not_checked("memory", kWhy);
    return 0;
  }
  if (const auto checked = check_thumbnail(config, rig, *size); !checked) {
    rows.wrong("limits", checked.error());
    rows.not_checked("memory", "there is no such thumbnail");
    return 0;
  }
  rows.ok("limits", "thumbnail " + std::to_string(size->width) + " x " +
                        std::to_string(size->height) + " px, " +
                        std::to_string(config.points_per_level) + " points a level");
  const MemoryMap map = map_memory(config, size->width, size->height);
  char memory[128];
  std::snprintf(memory, sizeof(memory), "%.2f of %.2f MiB%s",
                static_cast<double>(map.total_bytes()) / kMiB,
                static_cast<double>(memory_budget_bytes(size->width, size->height)) / kMiB,
                is_table_wanted ? ", as follows" : "; --memory lists every buffer");
  rows.ok("memory", memory);
  return map.total_bytes();
}

Result<int> finish(const CheckRows& rows) {
  std::fputs(format_rows(rows).c_str(), stdout);
  if (auto wrong = rows.first_wrong()) return tl::unexpected(std::move(*wrong));
  return 0;
}

// Nothing else can be told without a configuration.
Result<int> finish_without_config(const Error& error) {
  CheckRows rows;
  rows.wrong("configuration", error);
  for (const char* name : {"calibration", "camera", "image rows", "limits", "memory", "messages",
                           "clock", "real time", "memory lock", "core", "recording"}) {
    rows.not_checked(name, "the configuration is wrong");
  }
  return finish(rows);
}

Result<int> run(const CheckWords& words) {
  if (!words.size.empty() && !(words.source.empty() && words.width.empty())) {
    return failure(ExitCode::kUsage,
                   "--size is the thumbnail's: it goes with neither a SOURCE "
                   "nor --width");
  }
  const auto typed_size = parse_size(words.size);
  if (!typed_size) return tl::unexpected(typed_size.error());
  const auto config = read_config(words);
  if (!config) {
    if (config.error().code == ExitCode::kUsage) return tl::unexpected(config.error());
    return finish_without_config(config.error());
  }
  CheckRows rows;
  rows.ok("configuration", words.config.path.empty() ? "defaults" : words.config.path);
  const CheckedEyes eyes = check_cameras(*config, words.source, rows);
  const std::optional<StereoRig> rig = *typed_size ? std::nullopt : eyes.rig;
  const Thumbnail size = *typed_size ? *typed_size : choose_thumbnail(config->odometry, rig);
  if (!size && words.source.empty() && config->camera.source.empty()) {
    return failure(ExitCode::kUsage,
                   "width_px is 0, the source's width: give a SOURCE, or the thumbnail's --size");
  }
  check_matching_rows(config->odometry, eyes, rows);
  const std::uint64_t needed_bytes =
      add_memory(config->odometry, rig, size, words.is_memory_wanted, rows);
  check_system(*config, needed_bytes, rows);
  const auto finished = finish(rows);
  if (words.is_memory_wanted && needed_bytes > 0) {
    const MemoryMap map = map_memory(config->odometry, size->width, size->height);
    std::printf("\n%s", format_memory_table(map, size->width, size->height).c_str());
  }
  return finished;
}

constexpr const char* kMore =
    "A row says what was found of each thing that can be wrong before the service starts, and\n"
    "what to do about it: configuration, calibration, camera, whether both eyes see the same in "
    "the\n"
    "same row, limits, memory, the way for messages, clock, real-time priority, locked memory, "
    "core\n"
    "and room for recordings. Every row is printed; the exit code is that of the first wrong one, "
    "and\n"
    "0 when there are only warnings. Limits are those of the user who runs the check: run it as "
    "the\n"
    "service's. A camera must be free, so stop the service first.\n\n"
    "With a SOURCE, its images and its calibration are checked in place of the camera's, unless "
    "the\n"
    "key `calibration` names another; without any, sizes are those of 4:3 images.\n\n"
    "--memory lists every buffer that is claimed at start, the total and its budget, and how much\n"
    "stack a frame takes at most. Stages (written by, read by) are those of `stage_us` in the\n"
    "statistics of a replay.\n\n"
    "Examples:\n"
    "  darkling check --config rover.yaml\n"
    "  darkling check --set calibration=camchain.yaml ~/recordings/today\n"
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
  declare_config_options(command, words->config);
  command.add_option("--width", words->width, "Thumbnail width, height follows; 0: the source's")
      ->type_name("PX");
  command.footer(kMore);
  return [words] { return run(*words); };
}

}  // namespace darkling
