// SPDX-License-Identifier: Apache-2.0
#include "kernels/kernel_table.h"

#include <gmock/gmock.h>

#include "platform/cpu_features.h"

namespace darkling {
namespace {

using ::testing::HasSubstr;

constexpr CpuFeatures kNothing = {};
constexpr CpuFeatures kEverything = {.sse41 = true, .avx2 = true, .neon = true};

TEST(SelectKernels, GivesTheReferenceOnEveryProcessor) {
  const Result<KernelTable> table = select_kernels("ref", kNothing);
  ASSERT_TRUE(table);
  EXPECT_STREQ(table->name, "ref");
  EXPECT_EQ(table->bit_planes, bit_planes_ref);
  EXPECT_EQ(table->sample_residuals, sample_residuals_ref);
}

TEST(SelectKernels, FallsBackToTheReferenceWhenTheProcessorHasNothing) {
  const Result<KernelTable> table = select_kernels("auto", kNothing);
  ASSERT_TRUE(table);
  EXPECT_STREQ(table->name, "ref");
}

TEST(SelectKernels, RefusesAnUnknownNameAndListsTheKnown) {
  const Result<KernelTable> table = select_kernels("avx512", kNothing);
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().code, ExitCode::kUsage);
  EXPECT_EQ(table.error().message, "kernels `avx512` are not known; use one of: auto, ref");
}

TEST(SelectKernels, RefusesWhatTheProcessorLacks) {
  for (const char* name : {"sse41", "avx2", "neon"}) {
    const Result<KernelTable> table = select_kernels(name, kNothing);
    ASSERT_FALSE(table);
    EXPECT_EQ(table.error().code, ExitCode::kUsage);
    EXPECT_THAT(table.error().message, HasSubstr("not available on this processor"));
  }
}

#ifdef DARKLING_HAS_X86_KERNELS
TEST(SelectKernels, PicksTheWidestThatTheProcessorHas) {
  EXPECT_STREQ(select_kernels("auto", kEverything)->name, "avx2");
  EXPECT_EQ(select_kernels("auto", kEverything)->bit_planes, bit_planes_avx2);
  EXPECT_STREQ(select_kernels("auto", {.sse41 = true, .avx2 = false, .neon = false})->name,
               "sse41");
}

TEST(SelectKernels, GivesTheVariantAskedFor) {
  EXPECT_STREQ(select_kernels("sse41", kEverything)->name, "sse41");
  EXPECT_NE(select_kernels("sse41", kEverything)->bit_planes, bit_planes_avx2);
  EXPECT_EQ(select_kernels("ref", kEverything)->bit_planes, bit_planes_ref);
}

TEST(AvailableKernels, NamesTheReferenceFirst) {
  EXPECT_EQ(available_kernels(kEverything), "ref, sse41, avx2");
}
#endif

#ifdef DARKLING_HAS_NEON_KERNELS
TEST(SelectKernels, PicksNeonWhereThereIsNeon) {
  EXPECT_STREQ(select_kernels("auto", kEverything)->name, "neon");
}
#endif

TEST(AvailableKernels, AreAcceptedOneByOneHere) {
  const CpuFeatures cpu = detect_cpu_features();
  std::string names = available_kernels(cpu);
  for (const char* name : {"ref", "sse41", "avx2", "neon"}) {
    const bool is_listed =
        (", " + names + ",").find(std::string(", ") + name + ",") != std::string::npos;
    EXPECT_EQ(select_kernels(name, cpu).has_value(), is_listed) << name;
  }
}

}  // namespace
}  // namespace darkling
