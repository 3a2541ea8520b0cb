// SPDX-License-Identifier: Apache-2.0
#include "app/service/service_command_line.h"

#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>

#include "app/service/config_words.h"
#include "app/service/service.h"

namespace darkling {

namespace {

constexpr const char* kAbout =
    "Stereo visual odometry as a service: takes pairs of frames from two cameras and publishes "
    "over\n"
    "LCM how they have moved. Usually started by systemd (darklingd.service).";

constexpr const char* kMore =
    "Publishes VO_UPDATE and VO_POSE for every frame and VO_STATUS twice a second, whatever "
    "happens;\n"
    "listens to VO_COMMAND and VO_HINT. SIGHUP: read the configuration again. SIGTERM, SIGINT: "
    "stop.\n\n"
    "Examples:\n"
    "  darklingd --config /etc/darkling/darkling.yaml\n"
    "  darklingd --set camera=synthetic:corridor,frames=40     # without hardware\n"
    "  darklingd --print-config > darkling.yaml                # every key, explained\n\n"
    "Exit codes:\n"
    "  0 stopped as asked   64 usage   66 configuration unreadable   70 our own fault\n"
    "  78 configuration or calibration\n";

int report(const Error& error) {
  std::fflush(stdout);
  std::fprintf(stderr, "darklingd: %s\n", error.message.c_str());
  return static_cast<int>(error.code);
}

Result<int> print_config(const ServiceOptions& options) {
  const auto config = load_config(options.config_path, options.settings);
  if (!config) return tl::unexpected(config.error());
  std::fputs(format_config(*config).c_str(), stdout);
  return 0;
}

int run(int argc, const char* const* argv) {
  CLI::App app(kAbout, "darklingd");
  app.footer(kMore);
  app.set_version_flag("--version", "darklingd " DARKLING_VERSION);
  ServiceOptions options;
  ConfigWords config;
  bool is_config_wanted = false;
  declare_config_options(app, config);
  app.add_flag("--print-config", is_config_wanted,
               "Print the configuration that would be used, and stop");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {
    return app.exit(wish);
  } catch (const CLI::ParseError& e) {
    return report({ExitCode::kUsage, std::string(e.what()) + "\nTry: darklingd --help"});
  }
  options.config_path = config.path;
  options.settings = config.settings();
  const Result<int> done = is_config_wanted ? print_config(options) : run_service(options);
  return done ? *done : report(done.error());
}

}  // namespace

int run_service_command_line(int argc, const char* const* argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    return report({ExitCode::kInternal, std::string("unexpected failure: ") + e.what()});
  }
}

}  // namespace darkling
