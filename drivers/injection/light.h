// SPDX-License-Identifier: Apache-2.0
// Injections of light and exposure; docs/injections.md says what each means.
#pragma once

#include <memory>

#include "drivers/injection/injection.h"

namespace darkling {

[[nodiscard]] std::unique_ptr<Injector> make_electrons(const Injection& injection);
[[nodiscard]] std::unique_ptr<Injector> make_lamp(const Injection& injection);
[[nodiscard]] std::unique_ptr<Injector> make_vignette(const Injection& injection);
void apply_gain(const Injection& injection, InjectedPair& pair);
void apply_gamma(const Injection& injection, InjectedPair& pair);
void apply_flicker(const Injection& injection, InjectedPair& pair);
void apply_saturate(const Injection& injection, InjectedPair& pair);

}  // namespace darkling
