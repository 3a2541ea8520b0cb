// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace darkling::test {

// Runs `work` on a thread of its own whose stack was filled with a pattern before.
// @return how far below the thread's first frame the pattern is gone: the most stack `work` used at
//         one time, to within the pattern's eight bytes and what it left untouched at its deepest.
[[nodiscard]] std::size_t measure_stack_bytes(const std::function<void()>& work);

}  // namespace darkling::test
