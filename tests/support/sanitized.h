// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace darkling::test {

// Sanitizers bring an allocator of their own and make stack frames larger.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace darkling::test
