// SPDX-License-Identifier: Apache-2.0
#include "app/top/top_json.h"

#include <fstream>
#include <limits>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/message_cases.h"
#include "support/project_folder.h"

namespace darkling {
namespace {

using Json = nlohmann::json;

// The members that a message's definition declares, constants left out.
std::vector<std::string> members_of(const std::string& type) {
  std::ifstream file(test::project_folder() + "/src/messages/" + type + ".lcm");
  std::vector<std::string> members;
  const std::regex member(R"(^\s+(?:int\d+_t|double|boolean|string) (\w+)(?:\[\w+\])*;)");
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_search(line, match, member)) members.push_back(match[1]);
  }
  return members;
}

Heard heard_of(const status_t& status) {
  Heard heard;
  heard.take_status(encoded(status), {});
  return heard;
}

TEST(TopJson, HasEveryMemberOfEachMessageByItsName) {
  Heard heard = heard_of(extreme_status());
  heard.take_pose(encoded(extreme_pose()), {});
  heard.take_update(encoded(extreme_update()));
  const Json json = Json::parse(format_heard_json(heard));
  ASSERT_GT(members_of("status_t").size(), 30u);
  for (const std::string& member : members_of("status_t"))
    EXPECT_TRUE(json.contains(member)) << member;
  for (const std::string& member : members_of("pose_t")) {
    EXPECT_TRUE(json["pose"].contains(member)) << member;
  }
  for (const std::string& member : members_of("update_t")) {
    EXPECT_TRUE(json["update"].contains(member)) << member;
  }
}

TEST(TopJson, NamesStateAndReasons) {
  status_t status = {};
  status.state = status_t::STATE_DEGRADED;
  status.reasons = update_t::REASON_NO_DEPTH;
  status.reasons |= status_t::REASON_LATE;
  status.is_recording = 1;
  const Json json = Json::parse(format_heard_json(heard_of(status)));
  EXPECT_EQ(json["state"], 3);
  EXPECT_EQ(json["state_name"], "DEGRADED");
  EXPECT_EQ(json["reason_names"], Json({"no_depth", "late"}));
  EXPECT_EQ(json["is_recording"], true);
}

TEST(TopJson, HasNullForWhatWasNotHeardOrMeasured) {
  Heard heard = heard_of({});
  Json json = Json::parse(format_heard_json(heard));
  EXPECT_TRUE(json["pose"].is_null());
  EXPECT_TRUE(json["update"].is_null());
  EXPECT_EQ(json["reason_names"], Json::array());
  pose_t pose = {};
  pose.velocity[0] = std::numeric_limits<double>::quiet_NaN();
  heard.take_pose(encoded(pose), {});
  json = Json::parse(format_heard_json(heard));
  EXPECT_TRUE(json["pose"]["velocity"][0].is_null());
  EXPECT_EQ(json["pose"]["velocity"][1], 0.0);
}

TEST(TopJson, IsWholeWhenACamerasNameIsNoText) {
  status_t status = {};
  status.camera = "v4l2:\xff\xfe\n\"";
  EXPECT_TRUE(Json::accept(format_heard_json(heard_of(status))));
}

}  // namespace
}  // namespace darkling
