// SPDX-License-Identifier: Apache-2.0
#include "service/service_process.h"

#include <algorithm>

namespace darkling::test {

namespace {

std::vector<std::string> words_of(const std::string& url, const std::string& notify_path,
                                  milliseconds watchdog, const std::vector<std::string>& settings,
                                  const std::vector<std::string>& more_words) {
  const long long period_us = std::chrono::microseconds(watchdog).count();
  std::vector<std::string> words = {"/usr/bin/env", "NOTIFY_SOCKET=" + notify_path,
                                    "WATCHDOG_USEC=" + std::to_string(period_us),
                                    DARKLINGD_PROGRAM};
  words.insert(words.end(), more_words.begin(), more_words.end());
  const auto set = [&](const std::string& setting) {
    words.insert(words.end(), {"--set", setting});
  };
  set("lcm_url=" + url);
  const auto names_camera = [](const std::string& s) { return s.starts_with("camera="); };
  if (std::none_of(settings.begin(), settings.end(), names_camera) && more_words.empty()) {
    set(kSmallScene);
    set("width_px=96");
  }
  for (const std::string& setting : settings) set(setting);
  return words;
}

std::string prefix_of(const std::vector<std::string>& settings) {
  constexpr std::string_view kKey = "channel_prefix=";
  for (const std::string& s : settings) {
    if (s.starts_with(kKey)) return s.substr(kKey.size());
  }
  return "";
}

}  // namespace

ServiceProcess::ServiceProcess(std::vector<std::string> settings,
                               const std::vector<std::string>& more_words, milliseconds watchdog)
    : listener_(url_, prefix_of(settings)),
      program_(words_of(url_, notifications_.path(), watchdog, settings, more_words)) {}

bool ServiceProcess::reaches(std::int8_t state, milliseconds timeout) const {
  const std::size_t before = listener_.heard().statuses.size();
  return listener_.wait_until(
      [&](const Heard& heard) {
        return std::any_of(heard.statuses.begin() + static_cast<std::ptrdiff_t>(before),
                           heard.statuses.end(),
                           [&](const status_t& s) { return s.state == state; });
      },
      timeout);
}

}  // namespace darkling::test
