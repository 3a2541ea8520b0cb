// SPDX-License-Identifier: Apache-2.0
// Injections of where the cameras look and what is in their way; docs/injections.md says what each
// means.
#pragma once

#include <memory>

#include "drivers/injection/injection.h"

namespace darkling {

[[nodiscard]] std::unique_ptr<Injector> make_blur(const Injection& injection);
[[nodiscard]] std::unique_ptr<Injector> make_roll_right(const Injection& injection);
[[nodiscard]] std::unique_ptr<Injector> make_occlude(const Injection& injection);

}  // namespace darkling
