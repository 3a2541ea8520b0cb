// SPDX-License-Identifier: Apache-2.0
// Injections of light and exposure; docs/injections.md says what each means.
#pragma once

#include <memory>

#include "drivers/injection/injection.h"

namespace darkling {

[[nodiscard]] std::unique_ptr<Injector> make_electrons(const Injection& injection);
[[nodiscard]] std::unique_ptr<Injector> make_gain(const Injection& injection);

}  // namespace darkling
