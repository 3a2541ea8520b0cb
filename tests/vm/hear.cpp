// SPDX-License-Identifier: Apache-2.0
// What a running service publishes, as text: one line a message, `CHANNEL key=value key=value …`.
//
//   hear --for S [--until "CHANNEL CONDITION…"] [--times N] [--poses FILE]
//
// Listens for S seconds, or until N messages (default 1) of CHANNEL meet every CONDITION, one of
// key=value, key!=value, key<number, key>number. Exit code 0 when they came or none were asked for,
// 1 when they did not come, 69 without LCM. FILE gets valid poses as a TUM trajectory, by mono_ns.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <lcm/lcm-cpp.hpp>

#include "messages/channels.h"
#include "vm/message_text.h"

namespace darkling::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  double for_s = 0.0;
  std::string channel;  // empty: nothing is waited for
  std::vector<Condition> conditions;
  int times = 1;
  std::string poses_path;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i];
    const std::string value = argv[i + 1];
    if (word == "--for") {
      options.for_s = std::stod(value);
    } else if (word == "--times") {
      options.times = std::stoi(value);
    } else if (word == "--poses") {
      options.poses_path = value;
    } else if (word == "--until") {
      std::istringstream words(value);
      words >> options.channel;
      for (std::string text; words >> text;) options.conditions.push_back(parse_condition(text));
    } else {
      throw std::invalid_argument(word);
    }
  }
  if (argc % 2 == 0 || options.for_s <= 0.0) throw std::invalid_argument("--for S is missing");
  return options;
}

class Listener {
 public:
  explicit Listener(const Options& options) : options_(options) {
    if (!options.poses_path.empty()) poses_.open(options.poses_path);
  }

  template <class Message>
  void on_message(const lcm::ReceiveBuffer* /*buffer*/, const std::string& channel,
                  const Message* message) {
    const Fields fields = fields_of(*message);
    std::cout << channel;
    for (const auto& [key, value] : fields) std::cout << ' ' << key << '=' << value;
    std::cout << std::endl;
    if constexpr (std::is_same_v<Message, pose_t>) write_pose(*message);
    if (channel == options_.channel && meets_all(fields, options_.conditions)) ++met_;
  }

  [[nodiscard]] bool has_heard_enough() const {
    return !options_.channel.empty() && met_ >= options_.times;
  }

 private:
  void write_pose(const pose_t& pose) {
    if (!poses_.is_open() || pose.status != pose_t::STATUS_VALID) return;
    const double* const t = pose.translation;
    const double* const q = pose.rotation;
    poses_ << std::fixed << std::setprecision(9) << static_cast<double>(pose.mono_ns) * 1e-9 << ' '
           << t[0] << ' ' << t[1] << ' ' << t[2] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << ' '
           << q[0] << std::endl;
  }

  const Options& options_;
  std::ofstream poses_;
  int met_ = 0;
};

int hear(const Options& options) {
  lcm::LCM lcm("udpm://239.255.76.67:7667?ttl=0");
  if (!lcm.good()) {
    std::fprintf(stderr, "hear: LCM cannot be had; is there a multicast route?\n");
    return 69;
  }
  Listener listener(options);
  lcm.subscribe(kUpdateChannel, &Listener::on_message<update_t>, &listener);
  lcm.subscribe(kPoseChannel, &Listener::on_message<pose_t>, &listener);
  lcm.subscribe(kStatusChannel, &Listener::on_message<status_t>, &listener);
  const auto end = Clock::now() + std::chrono::duration<double>(options.for_s);
  while (!listener.has_heard_enough()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    if (left.count() <= 0) break;
    lcm.handleTimeout(static_cast<int>(left.count()));
  }
  return options.channel.empty() || listener.has_heard_enough() ? 0 : 1;
}

}  // namespace
}  // namespace darkling::test

int main(int argc, char** argv) {
  try {
    return darkling::test::hear(darkling::test::parse(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hear: %s\n", error.what());
    return 64;
  }
}
