// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace darkling::test {

// Of what is promised for every input: a fuzzer stops at what is thrown, a test fails.
inline void require(bool holds, const char* rule) {
  if (!holds) throw std::logic_error(rule);
}

}  // namespace darkling::test
