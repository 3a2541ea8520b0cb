// SPDX-License-Identifier: Apache-2.0
// The cases every pixel kernel must survive, and the kernels this processor can run.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "base/image_view.h"
#include "kernels/kernel_table.h"
#include "support/guarded_image.h"

namespace darkling {

// Lets a failing TEST_P name the variant.
void PrintTo(const KernelTable& table,
             std::ostream* stream);  // NOLINT(readability-identifier-naming)

}  // namespace darkling

namespace darkling::test {

// What the pixels hold: the places where comparisons, saturation and rounding go wrong.
enum class Fill { kUniform, kNearMin, kNearMax, kConstant, kSpike };
inline constexpr Fill kAllFills[] = {Fill::kUniform, Fill::kNearMin, Fill::kNearMax,
                                     Fill::kConstant, Fill::kSpike};
[[nodiscard]] const char* name_of(Fill fill);

// Fills with 8-bit grey levels; the same seed gives the same image.
void fill_image(ImageView<std::uint8_t> image, Fill fill, unsigned seed);

// Calls `check` for widths 1…max_width and heights 1…5 with odd strides, unaligned starts and the
// guard page on either side. @param max_width  px; 3 vectors + 1 reaches every loop and remainder.
void for_each_shape(int max_width, const std::function<void(const GuardedLayout&)>& check);

// The tables of this processor: ref first, then every variant it can run.
[[nodiscard]] std::vector<KernelTable> available_tables();

// "sse41" and so on, to name the instances of a TEST_P over available_tables().
[[nodiscard]] std::string table_name(const ::testing::TestParamInfo<KernelTable>& info);

}  // namespace darkling::test
