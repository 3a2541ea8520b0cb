// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling {

// Whether a person may be watching standard error: it is a terminal.
[[nodiscard]] bool is_stderr_terminal();

}  // namespace darkling
