// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <unistd.h>

#include "integration/darkling.h"

namespace darkling::test {

// A network of a test's own, so that tests that run at once do not hear each other: a port made of
// the process's number, and what channels begin with. Nothing leaves the machine.
struct OwnNetwork {
  std::string lcm_url =
      "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 10000) + "?ttl=0";
  std::string channel_prefix = "test" + std::to_string(getpid()) + "/";
};

// `darklingd` as built, on `network` with these settings besides.
[[nodiscard]] inline std::vector<std::string> darklingd_words(
    const OwnNetwork& network, const std::vector<std::string>& settings) {
  std::vector<std::string> words = {DARKLINGD_PROGRAM, "--set", "lcm_url=" + network.lcm_url,
                                    "--set", "channel_prefix=" + network.channel_prefix};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  return words;
}

}  // namespace darkling::test
