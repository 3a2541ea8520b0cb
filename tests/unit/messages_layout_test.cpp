// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <set>

#include <gtest/gtest.h>

#include "messages/bot_core/pose_t.hpp"
#include "messages/command_t.hpp"
#include "messages/frame_t.hpp"
#include "messages/gap_t.hpp"
#include "messages/hint_t.hpp"
#include "messages/pose_t.hpp"
#include "messages/rig_t.hpp"
#include "messages/status_t.hpp"
#include "messages/truth_t.hpp"
#include "messages/update_t.hpp"

namespace darkling {
namespace {

// What LCM computes of the names and types of a message's members, and receivers refuse another of.
// Once released a layout stays: who needs another member makes a new type beside the old one and
// sends both. Until then, a changed layout changes its line here, on purpose; a new type gets one.
struct Fingerprint {
  const char* type;
  std::int64_t found;
  std::uint64_t pinned;
};

const Fingerprint kFingerprints[] = {
    {"update_t", update_t::getHash(), 0x61804342cbeba72a},
    {"pose_t", pose_t::getHash(), 0x71aeddc55854689a},
    {"status_t", status_t::getHash(), 0x56aa441deac0343b},
    {"command_t", command_t::getHash(), 0x622b926a802c232d},
    {"hint_t", hint_t::getHash(), 0x255f0edaa4b4841e},
    {"rig_t", rig_t::getHash(), 0x7b0d57a9c940124e},
    {"frame_t", frame_t::getHash(), 0x95da66cf25676551},
    {"gap_t", gap_t::getHash(), 0x4f0c0092e077d0c8},
    {"truth_t", truth_t::getHash(), 0xb5cdee70495f57c3},
};

TEST(MessageLayouts, AreWhatTheyWere) {
  for (const Fingerprint& each : kFingerprints) {
    EXPECT_EQ(static_cast<std::uint64_t>(each.found), each.pinned)
        << each.type << std::hex << ": its fingerprint is now 0x" << each.found;
  }
}

// The package's name and the constants are not in it: equal members would decode as each other.
TEST(MessageLayouts, DifferFromEachOther) {
  std::set<std::int64_t> found;
  for (const Fingerprint& each : kFingerprints) found.insert(each.found);
  EXPECT_EQ(found.size(), std::size(kFingerprints));
}

// Its members are not ours to choose.
TEST(MessageLayouts, ThePoseForOthersIsTheOneTheyKnow) {
  constexpr std::uint64_t kBeforeRotation = 0x170b77d82958082f;
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::pose_t::getHash()),
            (kBeforeRotation << 1) + (kBeforeRotation >> 63));
}

TEST(MessageLayouts, HaveZeroForUnknown) {
  EXPECT_EQ(update_t{}.status, update_t::STATUS_UNKNOWN);
  EXPECT_EQ(pose_t{}.status, pose_t::STATUS_UNKNOWN);
  EXPECT_EQ(status_t{}.state, status_t::STATE_UNKNOWN);
  EXPECT_EQ(status_t{}.stamp_source, status_t::STAMP_UNKNOWN);
  EXPECT_EQ(command_t{}.command, command_t::COMMAND_UNKNOWN);
  EXPECT_EQ(rig_t{}.model[1], rig_t::MODEL_UNKNOWN);
  EXPECT_EQ(gap_t{}.fault, gap_t::FAULT_UNKNOWN);
  EXPECT_EQ(truth_t{}.key, truth_t::KEY_UNKNOWN);
}

}  // namespace
}  // namespace darkling
