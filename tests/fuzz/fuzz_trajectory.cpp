// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "support/hostile_text.h"

// libFuzzer's entry: one input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes,  // NOLINT
                                      std::size_t size) {
  darkling::test::read_any_trajectory(std::as_bytes(std::span(bytes, size)));
  return 0;
}
