// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <array>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/unknown_words.h"
#include "app/verb.h"

namespace darkling {

namespace {

constexpr const char* kAbout =
    "Stereo visual odometry: says from the frames of two cameras how they have moved, also in near "
    "darkness.\n"
    "The verbs below run the odometry over recordings, make synthetic ones, measure errors, "
    "record\n"
    "cameras and watch the service.";

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0 done   64 usage, or an output that cannot be written   65 input that makes no sense\n"
    "  66 input absent or unreadable   69 no camera, or no service heard   70 our own fault\n"
    "  78 configuration or calibration\n"
    "  130 interrupted; the outputs are whole up to there\n";

struct Verb {
  const char* name;
  const char* about;
  VerbAction (*declare)(CLI::App& command);
};
constexpr std::array kVerbs = std::to_array<Verb>({
    {"replay", "Run the odometry over a recording or a synthetic scene", declare_replay},
    {"render", "Write a synthetic stereo recording with exact truth", declare_render},
    {"convert", "Write any recording as a frame log or a dataset", declare_convert},
    {"check", "Say what would be wrong before a start, and what memory it takes", declare_check},
    {"eval", "Compare an estimated trajectory with the true one", declare_eval},
    {"bench", "Measure kernels and stages on this machine", declare_bench},
    {"record", "Write what a camera delivers to a frame log", declare_record},
    {"top", "Show a running service, live", declare_top},
});

int report_error(const Error& error) {
  std::fflush(stdout);
  std::fprintf(stderr, "darkling: %s\n", error.message.c_str());
  return static_cast<int>(error.code);
}

// CLI11 reports by exceptions; what it calls an error is a usage error here.
// @return the exit status when there is nothing left to do: help or the version was asked for.
Result<std::optional<int>> parse(CLI::App& app, const std::vector<std::string>& words) {
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // it wants them reversed
    return std::nullopt;
  } catch (const CLI::Success& wish) {
    return app.exit(wish);
  } catch (const CLI::ParseError& e) {
    const auto verbs = app.get_subcommands();
    const std::string verb = verbs.empty() ? "" : verbs.front()->get_name() + " ";
    return failure(ExitCode::kUsage, std::string(e.what()) + "\nTry: darkling " + verb + "--help");
  }
}

int run(const std::vector<std::string>& words) {
  CLI::App app(kAbout, "darkling");
  app.footer(std::string("darkling VERB --help tells more.\n\n") + kExitCodes);
  app.set_version_flag("--version", "darkling " DARKLING_VERSION);
  app.get_formatter()->label("SUBCOMMAND", "VERB");
  app.require_subcommand(1);
  std::vector<VerbAction> actions;
  for (const Verb& verb : kVerbs) {
    CLI::App* command = app.add_subcommand(verb.name, verb.about);
    command->group("Verbs");
    actions.push_back(verb.declare(*command));
    command->footer(command->get_footer() + "\n" + kExitCodes);
  }
  if (words.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return static_cast<int>(ExitCode::kUsage);
  }
  if (const auto known = check_words(app, words); !known) return report_error(known.error());
  const auto parsed = parse(app, words);
  if (!parsed) return report_error(parsed.error());
  if (*parsed) return **parsed;
  for (std::size_t i = 0; i < kVerbs.size(); ++i) {
    if (!app.got_subcommand(kVerbs[i].name)) continue;
    const auto done = actions[i]();
    return done ? *done : report_error(done.error());
  }
  return static_cast<int>(ExitCode::kUsage);
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    return report_error(Error{ExitCode::kInternal, std::string("unexpected failure: ") + e.what()});
  }
}

}  // namespace darkling
