// SPDX-License-Identifier: Apache-2.0
#include "base/check.h"

#include <cstdio>
#include <cstdlib>

namespace darkling {

void check_failed(const char* file, int line, const char* expression, const char* what) {
  std::fprintf(stderr, "%s:%d: CHECK failed: %s (%s)\n", file, line, expression, what);
  std::abort();
}

}  // namespace darkling
