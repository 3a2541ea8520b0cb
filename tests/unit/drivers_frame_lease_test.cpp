// SPDX-License-Identifier: Apache-2.0
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/frame_source.h"

namespace darkling {
namespace {

// Records which slots came back, in order.
struct Returns {
  std::vector<int> slots;

  static void give_back(void* source, int slot) {
    static_cast<Returns*>(source)->slots.push_back(slot);
  }
  FrameLease lease(int slot) {
    StereoFrame frame;
    frame.sequence = slot;
    return {frame, give_back, this, slot};
  }
};

TEST(FrameLease, GivesItsBufferBackExactlyOnce) {
  Returns returns;
  {
    const FrameLease lease = returns.lease(3);
    EXPECT_TRUE(lease.is_held());
    EXPECT_TRUE(returns.slots.empty());
  }
  EXPECT_EQ(returns.slots, std::vector<int>{3});
}

TEST(FrameLease, HoldsNothingByDefault) {
  const FrameLease lease;
  EXPECT_FALSE(lease.is_held());
}

TEST(FrameLease, MovesWithoutGivingBack) {
  Returns returns;
  {
    FrameLease first = returns.lease(3);
    const FrameLease second = std::move(first);
    EXPECT_FALSE(first.is_held());  // NOLINT(bugprone-use-after-move): what is left is the subject
    EXPECT_TRUE(second.is_held());
    EXPECT_EQ(second.frame().sequence, 3);
    EXPECT_TRUE(returns.slots.empty());
  }
  EXPECT_EQ(returns.slots, std::vector<int>{3});
}

TEST(FrameLease, GivesBackTheOldBufferWhenANewOneIsMovedIn) {
  Returns returns;
  {
    FrameLease lease = returns.lease(1);
    lease = returns.lease(2);
    EXPECT_EQ(returns.slots, std::vector<int>{1});
    EXPECT_EQ(lease.frame().sequence, 2);
  }
  EXPECT_EQ(returns.slots, (std::vector<int>{1, 2}));
}

TEST(FrameLease, GivesBackAtOnceWhenAnEmptyLeaseIsMovedIn) {
  Returns returns;
  FrameLease lease = returns.lease(1);
  lease = FrameLease();
  EXPECT_EQ(returns.slots, std::vector<int>{1});
  EXPECT_FALSE(lease.is_held());
}

TEST(FrameLease, KeepsItsBufferWhenMovedOntoItself) {
  Returns returns;
  FrameLease lease = returns.lease(1);
  FrameLease& same = lease;
  lease = std::move(same);
  EXPECT_TRUE(lease.is_held());
  EXPECT_TRUE(returns.slots.empty());
}

TEST(FrameLease, CannotBeCopied) {
  EXPECT_FALSE(std::is_copy_constructible_v<FrameLease>);
  EXPECT_FALSE(std::is_copy_assignable_v<FrameLease>);
}

}  // namespace
}  // namespace darkling
