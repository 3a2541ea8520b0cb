// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "base/result.h"

namespace darkling::test {

// @return the exit status when there is nothing left to do: help was asked for, or a word is wrong,
//         which is said.
[[nodiscard]] inline std::optional<int> parse_command_line(CLI::App& app, int argc,
                                                           const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::Success& wish) {
    return app.exit(wish);
  } catch (const CLI::ParseError& e) {
    const char* name = app.get_name().c_str();
    std::fprintf(stderr, "%s: %s\nTry: %s --help\n", name, e.what(), name);
    return static_cast<int>(ExitCode::kUsage);
  }
}

}  // namespace darkling::test
