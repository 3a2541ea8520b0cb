// SPDX-License-Identifier: Apache-2.0
// Injections of what is lost, late or mixed up between the sensors and us, and of streams that show
// nothing of use; docs/injections.md says what each means.
#pragma once

#include <memory>

#include "drivers/injection/injection.h"

namespace darkling {

[[nodiscard]] std::unique_ptr<Injector> make_freeze(const Injection& injection);
[[nodiscard]] std::unique_ptr<Injector> make_tear(const Injection& injection);
[[nodiscard]] std::unique_ptr<Injector> make_skew(const Injection& injection);
[[nodiscard]] FrameFault apply_drop(const Injection& injection, InjectedPair& pair);
[[nodiscard]] FrameFault apply_drop_every(const Injection& injection, InjectedPair& pair);
void apply_corrupt(const Injection& injection, InjectedPair& pair);
void apply_swap(const Injection& injection, InjectedPair& pair);

void apply_black(const Injection& injection, InjectedPair& pair);
void apply_white(const Injection& injection, InjectedPair& pair);
void apply_constant(const Injection& injection, InjectedPair& pair);
void apply_noise(const Injection& injection, InjectedPair& pair);
void apply_blackout(const Injection& injection, InjectedPair& pair);
void apply_cover(const Injection& injection, InjectedPair& pair);
void apply_same_eyes(const Injection& injection, InjectedPair& pair);

}  // namespace darkling
