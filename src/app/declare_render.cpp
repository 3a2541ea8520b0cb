// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/verb.h"
#include "app/verb_render.h"

namespace darkling {

namespace {

// What was typed.
struct RenderWords {
  std::string scene;
  std::string folder;
  // The keys that are options of their own; empty: not given.
  std::array<std::pair<const char*, std::string>, 4> keys = {
      {{"frames", ""}, {"seed", ""}, {"width", ""}, {"height", ""}}};
  std::vector<std::string> settings;
  std::string layout = "euroc";
  bool is_forced = false;
};

Result<SyntheticSpec> understand_spec(const RenderWords& words) {
  const bool has_prefix = words.scene.starts_with("synthetic:");
  auto spec = parse_synthetic(has_prefix ? words.scene : "synthetic:" + words.scene);
  if (!spec) return spec;
  // A height that follows from the scene's width is to follow from --width instead.
  if (words.scene.find("height=") == std::string::npos) spec->height = 0;
  for (const auto& [key, value] : words.keys) {
    if (value.empty()) continue;
    if (auto set = set_synthetic_key(*spec, key, value); !set) return tl::unexpected(set.error());
  }
  for (const std::string& setting : words.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos) {
      return failure(ExitCode::kUsage, "--set: found '" + setting + "', key=value is needed");
    }
    auto set = set_synthetic_key(*spec, setting.substr(0, equals), setting.substr(equals + 1));
    if (!set) return tl::unexpected(set.error());
  }
  return spec;
}

Result<int> run(const RenderWords& words) {
  const auto spec = understand_spec(words);
  if (!spec) return tl::unexpected(spec.error());
  if (words.layout != "euroc" && words.layout != "kitti") {
    return failure(ExitCode::kUsage,
                   "--layout: found '" + words.layout + "', allowed are euroc, kitti");
  }
  return run_render(
      {.spec = *spec,
       .folder = words.folder,
       .layout = words.layout == "kitti" ? DatasetLayout::kKitti : DatasetLayout::kEuroc,
       .is_forced = words.is_forced});
}

constexpr const char* kMore =
    "SCENE is mine (a tunnel in the light of a headlamp), quarry (rocks under a low sun) or\n"
    "corridor; keys may follow it as in a source of replay: mine,electrons=30.\n"
    "Keys, with --set or behind the scene:\n"
    "  frames seed width height rate_hz speed exposure_ms gain electrons read_noise_e\n"
    "  vignetting distortion roll_right_deg blur\n"
    "The same keys give the same bytes. Frames are whole on disk one by one: an interrupted run\n"
    "leaves a shorter recording.\n\n"
    "Examples:\n"
    "  darkling render mine out/mine --frames 100 --seed 7\n"
    "  darkling render quarry,electrons=30 out/dusk --layout kitti\n"
    "  darkling render mine out/rolled --set distortion=0.5 --set roll_right_deg=1\n";

}  // namespace

VerbAction declare_render(CLI::App& command) {
  auto words = std::make_shared<RenderWords>();
  command.add_option("SCENE", words->scene, "What to render")->required()->type_name("NAME");
  command.add_option("DIR", words->folder, "Where to; absent or empty")
      ->required()
      ->type_name("FOLDER");
  constexpr std::array kAbout = {"How many stereo pairs", "Of the scene, the motion and the noise",
                                 "Of the images", "Of the images; default three quarters of it"};
  constexpr std::array kTypes = {"N", "N", "PX", "PX"};
  for (std::size_t i = 0; i < words->keys.size(); ++i) {
    auto& [key, value] = words->keys[i];
    command.add_option(std::string("--") + key, value, kAbout[i])->type_name(kTypes[i]);
  }
  command.add_option("--set", words->settings, "One key of the scene; repeatable")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  command.add_option("--layout", words->layout, "Of the folder; default euroc")
      ->type_name("euroc|kitti");
  command.add_flag("--force", words->is_forced, "Write over an earlier recording in DIR");
  command.footer(kMore);
  return [words] { return run(*words); };
}

}  // namespace darkling
