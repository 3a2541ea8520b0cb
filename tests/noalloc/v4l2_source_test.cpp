// SPDX-License-Identifier: Apache-2.0
// A camera source claims its memory at the start: none for frames, bad frames, drops and stalls.
#include "drivers/v4l2/v4l2_source.h"

#include <type_traits>

#include <gtest/gtest.h>

#include "drivers/camera/jpeg_luma.h"
#include "platform/heap_probe.h"
#include "support/fake_v4l2.h"
#include "support/jpeg_images.h"
#include "support/sanitized.h"

namespace darkling::test {
namespace {

// The fake camera allocates, on the same thread; what it does is counted apart.
class CountedCalls final : public DeviceCalls {
 public:
  explicit CountedCalls(DeviceCalls& inner) : inner_(inner) {}

  int open(const char* path) override {
    return count([&] { return inner_.open(path); });
  }
  int close(int descriptor) override {
    return count([&] { return inner_.close(descriptor); });
  }
  int ioctl(int descriptor, unsigned long request, void* argument) override {
    return count([&] { return inner_.ioctl(descriptor, request, argument); });
  }
  Mapped map(int descriptor, std::size_t bytes, std::int64_t offset) override {
    return count([&] { return inner_.map(descriptor, bytes, offset); });
  }
  int unmap(void* address, std::size_t bytes) override {
    return count([&] { return inner_.unmap(address, bytes); });
  }
  int poll(std::span<pollfd> wanted, Duration timeout) override {
    return count([&] { return inner_.poll(wanted, timeout); });
  }
  [[nodiscard]] MonotonicTime now() const override { return inner_.now(); }

  // The heap calls of this thread that were not the fake's.
  [[nodiscard]] std::int64_t heap_calls_outside() const {
    return count_heap_calls().value() - inside_;
  }

 private:
  template <class Call>
  std::invoke_result_t<Call> count(Call call) {
    const std::int64_t before = count_heap_calls().value();
    const auto result = call();
    inside_ += count_heap_calls().value() - before;
    return result;
  }

  DeviceCalls& inner_;
  std::int64_t inside_ = 0;
};

struct Played {
  std::int64_t heap_calls = 0;
  SourceStats stats;
  int timeouts = 0;
};

// One of each five is cut short.
void paint_jpegs(FakeV4l2Device& camera) {
  camera.paint = [](std::uint32_t sequence, std::uint8_t* bytes) {
    const auto jpeg = jpeg_image(32, 16, {.is_colour = true, .seed = static_cast<int>(sequence)});
    std::copy(jpeg.begin(), jpeg.end(), bytes);
    return sequence % 5 == 3 ? jpeg.size() / 2 : jpeg.size();
  };
}

// A thousand waits with every fault that a source goes on after.
Played play(std::uint32_t fourcc, std::uint32_t stride_bytes) {
  FakeV4l2 system;
  std::array<FakeV4l2Device*, 2> cameras = {&system.device("/dev/video0"),
                                            &system.device("/dev/video1")};
  for (FakeV4l2Device* camera : cameras) {
    camera->formats = {{fourcc, 32, 16, stride_bytes, stride_bytes * 16}};
    camera->controls[V4L2_CID_EXPOSURE_ABSOLUTE].value = 50;
    if (fourcc == V4L2_PIX_FMT_MJPEG) paint_jpegs(*camera);
  }
  cameras[0]->alter = [](v4l2_buffer& buffer) {
    if (buffer.sequence % 50 == 7) buffer.flags |= V4L2_BUF_FLAG_ERROR;
    if (buffer.sequence % 50 == 17) buffer.bytesused = 0;
  };
  CountedCalls calls(system);
  const CameraConfig config = {.source = "v4l2:/dev/video0,/dev/video1"};
  auto source = V4l2Source::create(config, {.width = 32, .height = 16}, calls);
  EXPECT_TRUE(source);
  const std::int64_t before_start = calls.heap_calls_outside();
  EXPECT_TRUE((*source)->start());
  EXPECT_GT(calls.heap_calls_outside(), before_start);  // the probe sees this source's memory
  Played played;
  const std::int64_t before = calls.heap_calls_outside();
  std::array<WaitResult, 3> held;
  for (int i = 0; i < 1000; ++i) {
    cameras[1]->is_stalled = i % 100 > 90;
    cameras[0]->is_stalled = i % 100 > 95;
    WaitResult result = (*source)->wait_next(std::chrono::milliseconds(60));
    played.timeouts += result.status == WaitStatus::kTimeout ? 1 : 0;
    held[static_cast<std::size_t>(i) % held.size()] = std::move(result);
  }
  held = {};
  played.heap_calls = calls.heap_calls_outside() - before;
  played.stats = (*source)->stats();
  return played;
}

void expect_rough_but_without_heap(const Played& played) {
  EXPECT_EQ(played.heap_calls, 0);
  EXPECT_GT(played.stats.delivered, 500);
  EXPECT_GT(played.stats.unpaired, 20);
  EXPECT_GT(played.stats.device_errors, 20);
  EXPECT_GT(played.timeouts, 20);
}

TEST(V4l2SourceHeap, IsNotCalledForFramesShownInPlace) {
  if (kIsSanitized) GTEST_SKIP() << "no probe under sanitizers";
  expect_rough_but_without_heap(play(V4L2_PIX_FMT_GREY, 32));
}

TEST(V4l2SourceHeap, IsNotCalledForConvertedFrames) {
  if (kIsSanitized) GTEST_SKIP() << "no probe under sanitizers";
  expect_rough_but_without_heap(play(V4L2_PIX_FMT_YUYV, 64));
}

TEST(V4l2SourceHeap, IsNotCalledForJpegsWholeOrNot) {
  if (kIsSanitized) GTEST_SKIP() << "no probe under sanitizers";
  if (!can_decode_jpeg()) GTEST_SKIP() << "built without libjpeg";
  const Played played = play(V4L2_PIX_FMT_MJPEG, 256);
  expect_rough_but_without_heap(played);
  EXPECT_GT(played.stats.unreadable, 100);
}

}  // namespace
}  // namespace darkling::test
