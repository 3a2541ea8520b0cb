// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "integration/darklingd.h"

namespace darkling {
namespace {

using test::darklingd_words;
using test::run_darkling;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> kSmallCamera = {"camera=synthetic:corridor,frames=12,width=96",
                                               "width_px=96"};

std::vector<std::string> top_words(const test::OwnNetwork& network,
                                   const std::vector<std::string>& more) {
  std::vector<std::string> words = {"top", "--lcm-url", network.lcm_url, "--channel-prefix",
                                    network.channel_prefix};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// What `top --once --json` says once `is_met`; rendering on a busy machine takes its time.
nlohmann::json watch_until(const test::OwnNetwork& network,
                           const std::function<bool(const nlohmann::json&)>& is_met) {
  nlohmann::json last;
  for (int i = 0; i < 60; ++i) {
    const auto run = run_darkling(top_words(network, {"--once", "--json"}));
    if (run.status == 0) last = nlohmann::json::parse(run.out);
    if (run.status == 0 && is_met(last)) return last;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  ADD_FAILURE() << "not seen in time; last: " << last.dump(2);
  return last;
}

TEST(Top, SeesAServiceTrack) {
  const test::OwnNetwork network;
  test::RunningProgram service(darklingd_words(network, kSmallCamera));
  const auto json = watch_until(network, [](const nlohmann::json& status) {
    return status["state_name"] == "TRACKING" && !status["pose"].is_null();
  });
  ASSERT_FALSE(json.is_null());
  EXPECT_EQ(json["camera"], "synthetic:corridor,frames=12,width=96");
  EXPECT_EQ(json["width"], 96);
  EXPECT_GT(json["frames_tracked"], 0);
  EXPECT_EQ(json["pose"]["status"], 1);
  EXPECT_GT(json["update"]["quality"], 0);
  EXPECT_EQ(json["malformed_messages"], 0);

  const auto page = run_darkling(top_words(network, {"--once"}));
  EXPECT_EQ(page.status, 0) << page.err;
  EXPECT_THAT(page.out,
              AllOf(HasSubstr("quality"), HasSubstr("synthetic:corridor"), Not(HasSubstr("\033"))));

  // Without its prefix the service is not heard, but found.
  const auto strange = run_darkling({"top", "--lcm-url", network.lcm_url, "--once"});
  EXPECT_EQ(strange.status, 69);
  EXPECT_THAT(strange.err, HasSubstr("--channel-prefix '" + network.channel_prefix + "'"));

  // Where standard output is no terminal, it gets a line a second.
  const auto watched = run_darkling(top_words(network, {"--for", "4"}));
  EXPECT_EQ(watched.status, 0) << watched.err;
  EXPECT_THAT(watched.out, AllOf(HasSubstr(" quality "), Not(HasSubstr("\033"))));
  EXPECT_GE(test::count_lines(watched.out), 3u);
  EXPECT_LE(test::count_lines(watched.out), 5u);

  service.send_signal(SIGTERM);
  EXPECT_EQ(service.wait().status, 0);
}

TEST(Top, ExitsWith69WhereNobodyIs) {
  const test::OwnNetwork network;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--once"}, {"--once", "--json"}, {"--for", "0.5"}}) {
    const auto run = run_darkling(top_words(network, more));
    EXPECT_EQ(run.status, 69);
    EXPECT_THAT(run.err, AllOf(HasSubstr("No service heard on " + network.lcm_url),
                               HasSubstr("darklingd running?")));
  }
}

TEST(Top, SaysWhatIsWrongWithAUrl) {
  const auto run = run_darkling({"top", "--once", "--lcm-url", "carrier-pigeon://coop"});
  EXPECT_EQ(run.status, 69);
  EXPECT_THAT(run.err, AllOf(HasSubstr("LCM cannot be had on carrier-pigeon://coop"),
                             HasSubstr("udpm://GROUP:PORT?ttl=N"), HasSubstr("multicast route")));
}

TEST(Top, RefusesWhatDoesNotGoTogether) {
  EXPECT_EQ(run_darkling({"top", "--json"}).status, 64);
  EXPECT_EQ(run_darkling({"top", "--once", "--for", "3"}).status, 64);
  EXPECT_EQ(run_darkling({"top", "--for", "-3"}).status, 64);
}

}  // namespace
}  // namespace darkling
