// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <pthread.h>
#include <unistd.h>

#include "drivers/v4l2/device_calls.h"
#include "drivers/v4l2/v4l2_device.h"
#include "support/temporary_folder.h"

namespace darkling::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

class LinuxDeviceCallsTest : public ::testing::Test {
 protected:
  void SetUp() override { write_text(path_, "twelve bytes"); }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "file";
  DeviceCalls& calls_ = linux_device_calls();
};

TEST_F(LinuxDeviceCallsTest, GiveTheErrorNumberOfWhatFails) {
  EXPECT_EQ(calls_.open((folder_ / "absent").c_str()), -ENOENT);
  EXPECT_EQ(calls_.close(-1), -EBADF);
  EXPECT_EQ(calls_.map(-1, 4096, 0).error, -EBADF);
  EXPECT_EQ(calls_.map(-1, 4096, 0).address, nullptr);
  EXPECT_EQ(calls_.unmap(nullptr, 0), -EINVAL);
}

TEST_F(LinuxDeviceCallsTest, OpenMapAndClose) {
  const int descriptor = calls_.open(path_.c_str());
  ASSERT_GE(descriptor, 0);
  const DeviceCalls::Mapped mapped = calls_.map(descriptor, 12, 0);
  ASSERT_NE(mapped.address, nullptr);
  EXPECT_EQ(std::memcmp(mapped.address, "twelve bytes", 12), 0);
  v4l2_capability capability = {};
  EXPECT_EQ(calls_.ioctl(descriptor, VIDIOC_QUERYCAP, &capability), -ENOTTY);
  EXPECT_EQ(calls_.unmap(mapped.address, 12), 0);
  EXPECT_EQ(calls_.close(descriptor), 0);
}

TEST_F(LinuxDeviceCallsTest, LeadToAClearRefusalOfWhatIsNoCamera) {
  const auto device = V4l2Device::open(calls_, path_, {}, {.width = 32, .height = 16});
  ASSERT_FALSE(device.has_value());
  EXPECT_THAT(device.error().message, HasSubstr("this is no V4L2 device"));
}

TEST_F(LinuxDeviceCallsTest, PollSaysWhichIsReadableAndPassesOverWhatIsNotOpen) {
  std::array<int, 2> pipe_ends = {};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  std::array<pollfd, 2> wanted = {{{.fd = -1, .events = POLLIN, .revents = 0},
                                   {.fd = pipe_ends[0], .events = POLLIN, .revents = 0}}};
  EXPECT_EQ(calls_.poll(wanted, Duration::zero()), 0);
  ASSERT_EQ(write(pipe_ends[1], "x", 1), 1);
  EXPECT_EQ(calls_.poll(wanted, std::chrono::seconds(10)), 1);
  EXPECT_EQ(wanted[0].revents, 0);
  EXPECT_EQ(wanted[1].revents, POLLIN);
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

TEST_F(LinuxDeviceCallsTest, PollWaitsOnAfterASignal) {
  struct sigaction action = {};
  struct sigaction before = {};
  action.sa_handler = [](int) {};
  ASSERT_EQ(sigaction(SIGUSR1, &action, &before), 0);
  const pthread_t waiter = pthread_self();
  std::thread disturber([waiter] {
    for (int i = 0; i < 5; ++i) {
      std::this_thread::sleep_for(milliseconds(5));
      pthread_kill(waiter, SIGUSR1);
    }
  });
  const MonotonicTime since = calls_.now();
  EXPECT_EQ(calls_.poll({}, milliseconds(100)), 0);
  EXPECT_GE(calls_.now() - since, milliseconds(100));
  disturber.join();
  ASSERT_EQ(sigaction(SIGUSR1, &before, nullptr), 0);
}

}  // namespace
}  // namespace darkling::test
