// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <type_traits>

#include "drivers/injection/injection.h"

namespace darkling {

// An injector that knows nothing of other pairs and needs no memory: a function of the injection
// and the pair, which returns nothing, or why the pair is lost.
template <auto Apply>
class Stateless final : public Injector {
 public:
  explicit Stateless(const Injection& injection) : injection_(injection) {}

  FrameFault inject(InjectedPair& pair) override {
    using Returned = std::invoke_result_t<decltype(Apply), const Injection&, InjectedPair&>;
    if constexpr (std::is_void_v<Returned>) {
      Apply(injection_, pair);
      return FrameFault::kNone;
    } else {
      return Apply(injection_, pair);
    }
  }

 private:
  Injection injection_;
};

template <auto Apply>
std::unique_ptr<Injector> make_stateless(const Injection& injection) {
  return std::make_unique<Stateless<Apply>>(injection);
}

}  // namespace darkling
