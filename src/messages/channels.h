// SPDX-License-Identifier: Apache-2.0
// The names of the channels. The service puts its configured prefix before those of VO_*; LCM takes
// 63 characters, which leaves 53 for it.
#pragma once

namespace darkling {

inline constexpr const char* kUpdateChannel = "VO_UPDATE";    // update_t
inline constexpr const char* kPoseChannel = "VO_POSE";        // pose_t
inline constexpr const char* kStatusChannel = "VO_STATUS";    // status_t
inline constexpr const char* kBotCorePoseChannel = "POSE";    // bot_core.pose_t, when configured
inline constexpr const char* kCommandChannel = "VO_COMMAND";  // command_t, to the service
inline constexpr const char* kHintChannel = "VO_HINT";        // hint_t, to the service

// Of frame logs only.
inline constexpr const char* kRigChannel = "DARKLING_RIG";      // rig_t
inline constexpr const char* kTruthChannel = "DARKLING_TRUTH";  // truth_t
inline constexpr const char* kFrameChannel = "DARKLING_FRAME";  // frame_t
inline constexpr const char* kGapChannel = "DARKLING_GAP";      // gap_t

}  // namespace darkling
