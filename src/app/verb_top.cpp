// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "app/top/top.h"
#include "app/verb.h"
#include "base/number_text.h"

namespace darkling {

namespace {

// What was typed.
struct TopWords {
  TopOptions options;
  std::optional<double> for_s;
};

Result<int> run(const TopWords& words) {
  TopOptions options = words.options;
  if (options.is_json && !options.is_once) {
    return failure(ExitCode::kUsage, "--json goes with --once: a live page has no JSON");
  }
  if (options.is_once && words.for_s) {
    return failure(ExitCode::kUsage, "--for is for watching, --once ends by itself: give one");
  }
  constexpr double kMost_s = 1e9;
  if (words.for_s && !(*words.for_s > 0.0 && *words.for_s <= kMost_s)) {
    return failure(ExitCode::kUsage, "--for: found " + number_text(*words.for_s) +
                                         ", allowed are seconds above 0 up to 1e9");
  }
  if (words.for_s) {
    options.duration =
        std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*words.for_s));
  }
  return run_top(options);
}

constexpr const char* kMore =
    "Listens to VO_STATUS, VO_POSE and VO_UPDATE, as darklingd publishes them, and shows on a "
    "page\n"
    "of 80x24: the state and its reasons, quality, rates, latency, what was lost where, the "
    "camera,\n"
    "memory, the pose with its sigma, and the track seen from above (x up, o where watching "
    "began,\n"
    "@ where it is now). q or Ctrl-C ends it. Nothing is sent: any number may watch.\n\n"
    "quality  1 (worst) to 100 of the last frame\n"
    "sigma    of the pose since tracking started, position and attitude; `driven` counts since\n"
    "         watching began, in steps of 5 cm\n"
    "yaw      to the left, pitch nose down, roll right side down, all positive\n"
    "skipped  because a newer pair was there\n"
    "late     estimates after more than a frame's period; refinements that were waited for\n"
    "SILENT   statuses come twice a second; none has come for 2 s\n\n"
    "When standard output is no terminal it gets a line a second. --once waits 2 s at most for a\n"
    "status, and exits 69 when none is heard; in --json every field of status_t has its name, "
    "with\n"
    "state_name and reason_names besides, and pose and update are the last of these messages.\n\n"
    "Examples:\n"
    "  darkling top                                # the service of this machine\n"
    "  darkling top --channel-prefix rover1/       # as its configuration's channel_prefix\n"
    "  darkling top --once --json | jq .state_name\n"
    "  darkling top --for 60 > minute.txt\n";

}  // namespace

VerbAction declare_top(CLI::App& command) {
  auto words = std::make_shared<TopWords>();
  command
      .add_option("--lcm-url", words->options.lcm_url,
                  "Where it publishes; default " + words->options.lcm_url)
      ->type_name("URL");
  command
      .add_option("--channel-prefix", words->options.channel_prefix,
                  "What its channels' names begin with")
      ->type_name("TEXT");
  command.add_flag("--once", words->options.is_once, "Print one page, and stop");
  command.add_flag("--json", words->options.is_json, "With --once: print JSON");
  command.add_option("--for", words->for_s, "Stop watching after so long")->type_name("SECONDS");
  command.footer(kMore);
  return [words] { return run(*words); };
}

}  // namespace darkling
