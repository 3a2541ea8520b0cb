// SPDX-License-Identifier: Apache-2.0
#include "kernels/arithmetic_peak.h"

namespace darkling {

ArithmeticPeak arithmetic_peak([[maybe_unused]] std::string_view kernels) {
#ifdef DARKLING_HAS_X86_KERNELS
  if (kernels == "avx2") return {32, byte_arithmetic_avx2, float_arithmetic_avx2};
#endif
#ifdef DARKLING_HAS_NEON_KERNELS
  if (kernels == "neon") return {16, byte_arithmetic_neon, float_arithmetic_neon};
#endif
  return {};
}

}  // namespace darkling
