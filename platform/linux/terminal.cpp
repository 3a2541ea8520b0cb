// SPDX-License-Identifier: Apache-2.0
#include "platform/terminal.h"

#include <unistd.h>

namespace darkling {

bool is_stderr_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

}  // namespace darkling
