// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "base/result.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a name of CLI11
class App;
}

namespace darkling {

// What a verb does once its options are parsed; the value is the process's exit status.
using VerbAction = std::function<Result<int>()>;

// Each adds the options and the help of one verb to its command and returns what is to be done.
[[nodiscard]] VerbAction declare_replay(CLI::App& command);
[[nodiscard]] VerbAction declare_check(CLI::App& command);
[[nodiscard]] VerbAction declare_eval(CLI::App& command);
[[nodiscard]] VerbAction declare_render(CLI::App& command);
[[nodiscard]] VerbAction declare_convert(CLI::App& command);
[[nodiscard]] VerbAction declare_bench(CLI::App& command);
[[nodiscard]] VerbAction declare_record(CLI::App& command);
[[nodiscard]] VerbAction declare_top(CLI::App& command);

// Ended by SIGINT or SIGTERM: what shells report for a program that SIGINT killed.
inline constexpr int kInterruptedStatus = 130;

}  // namespace darkling
