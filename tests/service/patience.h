// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "support/sanitized.h"

namespace darkling::test {

// How long a test waits for what should come. Generous: several tests share the machine, and under
// a sanitizer a scene takes ten seconds to render.
inline constexpr auto kPatience = std::chrono::seconds(kIsSanitized ? 60 : 20);

}  // namespace darkling::test
