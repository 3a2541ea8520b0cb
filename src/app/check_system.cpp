// SPDX-License-Identifier: Apache-2.0
#include "app/check_system.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <fcntl.h>
#include <lcm/lcm.h>
#include <unistd.h>

#include "base/number_text.h"
#include "platform/clocks.h"
#include "platform/disk.h"
#include "platform/limits.h"

namespace darkling {

namespace {

constexpr double kMB = 1e6;
constexpr double kMiB = 1024.0 * 1024.0;

// LCM says on stderr what we say ourselves.
class SilentStderr {
 public:
  SilentStderr() : kept_(dup(STDERR_FILENO)) {
    std::fflush(stderr);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  ~SilentStderr() {
    if (kept_ < 0) return;
    std::fflush(stderr);
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  SilentStderr(const SilentStderr&) = delete;
  SilentStderr& operator=(const SilentStderr&) = delete;

 private:
  int kept_;
};

bool can_publish(const std::string& url) {
  const SilentStderr silent;
  lcm_t* lcm = lcm_create(url.c_str());
  if (lcm == nullptr) return false;
  lcm_destroy(lcm);
  return true;
}

// "239.255.76.67" of "udpm://239.255.76.67:7667?ttl=0".
std::string group_of(const std::string& url) {
  const std::size_t begin = url.find("://") + 3;
  return url.substr(begin, url.find_first_of(":?/", begin) - begin);
}

// Without a camera nobody is about to start the service: a machine of the desk without a route is
// nothing wrong.
void check_messages(const Config& config, CheckRows& rows) {
  constexpr const char* kName = "messages";
  const std::string& url = config.service.lcm_url;
  if (!url.starts_with("udpm://")) {
    rows.wrong(kName, {ExitCode::kConfiguration,
                       "key 'lcm_url': found '" + url + "', allowed is udpm://GROUP:PORT?ttl=N"});
    return;
  }
  if (can_publish(url)) {
    rows.ok(kName, url);
    return;
  }
  const std::string group = group_of(url);
  const std::string text =
      url +
      ": LCM cannot send there; most likely no route leads to the group. Within this machine:\n"
      "ip route add " +
      (group.empty() ? "239.255.76.67" : group) +
      "/32 dev lo; ip link set lo multicast on\n"
      "Else key 'lcm_url' is wrong; allowed is udpm://GROUP:PORT?ttl=N";
  if (config.camera.source.empty()) {
    rows.warning(kName, text);
  } else {
    rows.wrong(kName, {ExitCode::kConfiguration, text});
  }
}

void check_clock(CheckRows& rows) {
  constexpr const char* kName = "clock";
  constexpr std::int64_t kYear2025_s = 1'735'689'600;
  const auto now_s =
      std::chrono::duration_cast<std::chrono::seconds>(read_epoch_clock().time_since_epoch());
  if (now_s.count() < kYear2025_s) {
    rows.wrong(kName, {ExitCode::kConfiguration,
                       "the system's time is before 2025, so messages and recordings would be "
                       "labelled wrongly; set it (timedatectl set-time), or let the service start "
                       "after time-sync.target"});
    return;
  }
  const auto is_synchronised = is_epoch_clock_synchronised();
  if (is_synchronised && !*is_synchronised) {
    rows.warning(kName,
                 "plausible, but not synchronised: other machines' times may differ; does "
                 "systemd-timesyncd, chrony or ptp run?");
    return;
  }
  rows.ok(kName, is_synchronised ? "synchronised" : "plausible");
}

void check_priority(const ServiceConfig& service, CheckRows& rows) {
  constexpr const char* kName = "real time";
  if (service.realtime_priority == 0) {
    rows.not_checked(kName, "realtime_priority is 0");
    return;
  }
  const std::string wanted = std::to_string(service.realtime_priority);
  const int most = read_most_realtime_priority();
  if (service.realtime_priority <= most) {
    rows.ok(kName, "priority " + wanted + " of at most " + std::to_string(most));
    return;
  }
  rows.wrong(kName,
             {ExitCode::kConfiguration,
              "key 'realtime_priority': found " + wanted + ", this user is allowed at most " +
                  std::to_string(most) + " (RLIMIT_RTPRIO); set LimitRTPRIO=" + wanted +
                  " in the unit, or rtprio in /etc/security/limits.conf"});
}

void check_memory_lock(const ServiceConfig& service, std::uint64_t needed_bytes, CheckRows& rows) {
  constexpr const char* kName = "memory lock";
  if (!service.lock_memory) {
    rows.not_checked(kName, "lock_memory is false");
    return;
  }
  // Libraries, stacks of eight threads of 8 MiB and the camera's buffers are locked, too.
  constexpr std::uint64_t kBesides_bytes = 192U << 20;
  const auto most_bytes = read_most_locked_bytes();
  if (!most_bytes) {
    rows.ok(kName, "no limit");
    return;
  }
  const std::string most = number_text(static_cast<double>(*most_bytes) / kMiB) + " MiB";
  const std::uint64_t wanted_bytes = needed_bytes + kBesides_bytes;
  if (*most_bytes >= wanted_bytes) {
    rows.ok(kName, "at most " + most);
    return;
  }
  rows.wrong(kName, {ExitCode::kConfiguration,
                     "key 'lock_memory': this user may lock " + most + " (RLIMIT_MEMLOCK), some " +
                         std::to_string(wanted_bytes >> 20) +
                         " MiB are needed; set LimitMEMLOCK=infinity in the unit, or memlock in "
                         "/etc/security/limits.conf"});
}

void check_core(const ServiceConfig& service, CheckRows& rows) {
  constexpr const char* kName = "core";
  if (service.cpu < 0) {
    rows.not_checked(kName, "cpu is -1, any");
    return;
  }
  const std::vector<int> allowed = read_allowed_cores();
  const std::string wanted = std::to_string(service.cpu);
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), service.cpu) != allowed.end()) {
    rows.ok(kName, wanted);
    return;
  }
  std::string list;
  for (const int core : allowed) list += (list.empty() ? "" : ", ") + std::to_string(core);
  rows.wrong(kName, {ExitCode::kConfiguration,
                     "key 'cpu': found " + wanted + ", online and allowed are " + list});
}

void check_disk(const ServiceConfig& service, CheckRows& rows) {
  constexpr const char* kName = "recording";
  const std::string& folder = service.record_to;
  if (folder.empty()) {
    if (service.record || service.black_box_s > 0.0) {
      rows.wrong(kName,
                 {ExitCode::kConfiguration,
                  "key 'record_to': found '', a folder is needed for record and black_box_s"});
      return;
    }
    rows.not_checked(kName, "record_to is empty");
    return;
  }
  const auto free_bytes = read_free_bytes(folder);
  if (!free_bytes) {
    rows.wrong(kName, {ExitCode::kConfiguration,
                       "key 'record_to': " + free_bytes.error().message +
                           "; allowed is a folder that the service's user may write in"});
    return;
  }
  const double free_mb = static_cast<double>(*free_bytes) / kMB;
  const std::string text = folder + ": " + std::to_string(*free_bytes / 1'000'000) + " MB free";
  if (free_mb < service.record_limit_mb) {
    rows.wrong(kName, {ExitCode::kConfiguration,
                       "key 'record_to': " + text + ", record_limit_mb is " +
                           std::to_string(service.record_limit_mb) + "; make room, or lower it"});
    return;
  }
  rows.ok(kName, text);
}

}  // namespace

void check_system(const Config& config, std::uint64_t needed_bytes, CheckRows& rows) {
  check_messages(config, rows);
  check_clock(rows);
  check_priority(config.service, rows);
  check_memory_lock(config.service, needed_bytes, rows);
  check_core(config.service, rows);
  check_disk(config.service, rows);
}

}  // namespace darkling
