// SPDX-License-Identifier: Apache-2.0
#include "platform/process_memory.h"

#include <cstdio>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

namespace darkling {

// Not getrusage(): its maximum survives exec, so a small program started by a large one inherits
// the large one's peak.
std::optional<std::int64_t> read_peak_rss_bytes() {
  std::FILE* status = std::fopen("/proc/self/status", "r");
  if (status == nullptr) return std::nullopt;
  std::optional<std::int64_t> peak_bytes;
  char line[256];
  while (!peak_bytes && std::fgets(line, sizeof(line), status) != nullptr) {
    long long peak_kib = 0;
    if (std::sscanf(line, "VmHWM: %lld kB", &peak_kib) == 1) peak_bytes = peak_kib * 1024;
  }
  std::fclose(status);
  return peak_bytes;
}

std::optional<std::int64_t> read_rss_bytes() {
  const int fd = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (fd < 0) return std::nullopt;
  char text[128] = {};
  const ssize_t length = read(fd, text, sizeof(text) - 1);
  close(fd);
  long long size_pages = 0;
  long long resident_pages = 0;
  if (length <= 0 || std::sscanf(text, "%lld %lld", &size_pages, &resident_pages) != 2) {
    return std::nullopt;
  }
  return resident_pages * sysconf(_SC_PAGESIZE);
}

void return_free_memory() {
#ifdef __GLIBC__
  static_cast<void>(malloc_trim(0));
#endif
}

}  // namespace darkling
