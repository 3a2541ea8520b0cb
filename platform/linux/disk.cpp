// SPDX-License-Identifier: Apache-2.0
#include "platform/disk.h"

#include <cerrno>
#include <cstring>

#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace darkling {

Result<std::uint64_t> read_free_bytes(const std::string& folder) {
  const auto refuse = [&folder](const std::string& reason) {
    return failure(ExitCode::kConfiguration, folder + ": " + reason);
  };
  struct stat status = {};
  if (stat(folder.c_str(), &status) != 0) return refuse(std::strerror(errno));
  if (!S_ISDIR(status.st_mode)) return refuse("is no folder");
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    return refuse(std::string("cannot be written in: ") + std::strerror(errno));
  }
  struct statvfs space = {};
  if (statvfs(folder.c_str(), &space) != 0) return refuse(std::strerror(errno));
  return std::uint64_t{space.f_bavail} * space.f_frsize;
}

}  // namespace darkling
