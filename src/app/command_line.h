// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

// The program `darkling`: finds the verb, parses its options, does it, prints errors.
// @return the process's exit status: ExitCode, or kInterruptedStatus.
[[nodiscard]] int run_command_line(int argc, const char* const* argv);

}  // namespace darkling
