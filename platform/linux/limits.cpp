// SPDX-License-Identifier: Apache-2.0
#include "platform/limits.h"

#include <algorithm>
#include <cstdio>

#include <linux/capability.h>
#include <sched.h>
#include <sys/resource.h>

namespace darkling {

namespace {

// Whether the process may do what limits do not bind; a root without capabilities may not.
bool has_capability(int number) {
  std::FILE* status = std::fopen("/proc/self/status", "r");
  if (status == nullptr) return false;
  unsigned long long effective = 0;
  char line[256];
  while (std::fgets(line, sizeof(line), status) != nullptr) {
    if (std::sscanf(line, "CapEff: %llx", &effective) == 1) break;
  }
  std::fclose(status);
  return ((effective >> number) & 1U) != 0;
}

}  // namespace

int read_most_realtime_priority() {
  constexpr rlim_t kMost = 99;
  if (has_capability(CAP_SYS_NICE)) return static_cast<int>(kMost);
  rlimit limit = {};
  if (getrlimit(RLIMIT_RTPRIO, &limit) != 0) return 0;
  return static_cast<int>(std::min(limit.rlim_cur, kMost));
}

std::optional<std::uint64_t> read_most_locked_bytes() {
  rlimit limit = {};
  if (has_capability(CAP_IPC_LOCK) || getrlimit(RLIMIT_MEMLOCK, &limit) != 0) return std::nullopt;
  if (limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

std::vector<int> read_allowed_cores() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<unsigned>(core), &allowed)) cores.push_back(core);
  }
  return cores;
}

}  // namespace darkling
