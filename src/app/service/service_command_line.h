// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

// `darklingd`: understands the command line, runs the service and says what went wrong.
// @return the exit status.
[[nodiscard]] int run_service_command_line(int argc, const char* const* argv);

}  // namespace darkling
