// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/injected_recording.h"
#include "app/record.h"
#include "app/service/config_words.h"
#include "app/verb.h"
#include "base/number_text.h"

namespace darkling {

namespace {

// What was typed.
struct RecordWords {
  RecordOptions options;
  ConfigWords config;
  std::optional<double> for_s;
  std::vector<std::string> injections;
};

Result<int> run(const RecordWords& words) {
  RecordOptions options = words.options;
  constexpr double kMost_s = 1e9;
  if (words.for_s && !(*words.for_s > 0.0 && *words.for_s <= kMost_s)) {
    return failure(ExitCode::kUsage, "--for: found " + number_text(*words.for_s) +
                                         ", allowed are seconds above 0 up to 1e9");
  }
  if (words.for_s) {
    options.duration =
        std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*words.for_s));
  }
  if (options.frame_count && *options.frame_count < 1) {
    return failure(ExitCode::kUsage, "--frames: found " + std::to_string(*options.frame_count) +
                                         ", allowed is 1 and more");
  }
  auto injections = parse_injections(words.injections);
  if (!injections) return tl::unexpected(injections.error());
  options.injections = std::move(*injections);
  options.config_path = words.config.path;
  options.settings = words.config.settings();
  return record(options);
}

constexpr const char* kMore =
    "Takes pairs from the camera of the configuration, as darklingd would, and writes them to\n"
    "OUT without tracking: full images, the calibration, and the configuration in force. A pair\n"
    "that was lost or unusable is recorded as a gap. A running service has the camera for\n"
    "itself: stop it first, or let it record (`record_to` of its configuration).\n\n"
    "--inject is as of `darkling replay`, which lists all there is: what is recorded is what was\n"
    "injected. Frames count from when the camera is opened.\n\n"
    "Without --for and --frames it goes on until Ctrl-C; whatever ends it, OUT is whole then.\n"
    "It ends by itself at record_limit_mb of the configuration, too. 640x480 at 20 Hz are 12 MB a\n"
    "second. Exits 69 when there is no camera, it is taken, or it goes away.\n\n"
    "Examples:\n"
    "  darkling record drive.lcmlog --config /etc/darkling/darkling.yaml\n"
    "  darkling record drive.lcmlog --set camera=v4l2:/dev/video0,/dev/video1 \\\n"
    "      --set calibration=camchain.yaml --for 60\n"
    "  darkling record try.lcmlog --set camera=synthetic:mine,frames=40 --frames 100\n"
    "  darklingd --set camera=drive.lcmlog      # plays it as if it were a camera\n";

}  // namespace

VerbAction declare_record(CLI::App& command) {
  auto words = std::make_shared<RecordWords>();
  RecordOptions& options = words->options;
  command.add_option("OUT", options.output, "The frame log to write")
      ->required()
      ->type_name("FILE.lcmlog");
  declare_config_options(command, words->config);
  command.add_option("--for", words->for_s, "Stop after so long from the first pair on")
      ->type_name("SECONDS");
  command.add_option("--frames", options.frame_count, "Stop after so many pairs")->type_name("N");
  declare_inject_option(command, words->injections);
  command.add_flag("--force", options.is_forced, "Write over a file that is there");
  command.footer(kMore);
  return [words] { return run(*words); };
}

}  // namespace darkling
