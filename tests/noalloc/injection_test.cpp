// SPDX-License-Identifier: Apache-2.0
// Injections claim their memory at the start.
#include <memory>

#include <gtest/gtest.h>

#include "drivers/injection/injected_source.h"
#include "platform/heap_probe.h"
#include "support/plain_source.h"
#include "support/sanitized.h"

namespace darkling {
namespace {

constexpr ImageSize kSize{.width = 60, .height = 40};

std::string gentle(const InjectionKind& kind) {
  const std::string name(kind.name);
  if (kind.form == ValueForm::kNone) return name;
  if (kind.form == ValueForm::kWord) return name + "=left";
  if (kind.form == ValueForm::kWholeNumber) return name + "=5";
  return name + "=" + std::to_string(0.5 * kind.highest);
}

TEST(InjectionHeap, IsNotCalledForFrames) {
  if (test::kIsSanitized) GTEST_SKIP() << "no probe under sanitizers";
  for (const InjectionKind& kind : injection_kinds()) {
    const auto injection = parse_injection(gentle(kind));
    ASSERT_TRUE(injection.has_value()) << injection.error().message;
    InjectedSource source(
        std::make_unique<test::PlainSource>(kSize, test::drifting_pairs(kSize, 100)), kSize,
        {*injection});
    const auto before_start = count_heap_calls();
    ASSERT_TRUE(source.start().has_value());
    const auto started = count_heap_calls();
    EXPECT_GT(started.value(), before_start.value()) << "the probe sees the buffers";
    int frames = 0;
    while (source.wait_next({}).status != WaitStatus::kEndOfSource) ++frames;
    EXPECT_EQ(count_heap_calls().value(), started.value()) << kind.name;
    EXPECT_EQ(frames, 100);
    source.stop();
  }
}

}  // namespace
}  // namespace darkling
