// SPDX-License-Identifier: Apache-2.0
#include "app/service/claim_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace darkling {

Result<std::string> claim_file(const std::string& start, const std::string& end) {
  constexpr mode_t kAnyone = 0666;  // as far as the umask lets
  for (int number = 1; number <= kMostOfOneName; ++number) {
    const std::string path = start + (number > 1 ? "-" + std::to_string(number) : "") + end;
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kAnyone);
    if (descriptor >= 0) {
      ::close(descriptor);
      return path;
    }
    if (errno == EEXIST) continue;
    return failure(ExitCode::kUsage,
                   path + ": cannot be opened for writing: " + std::strerror(errno));
  }
  return failure(ExitCode::kUsage, start + end + ": exists, and so do all up to " + start + "-" +
                                       std::to_string(kMostOfOneName) + end +
                                       "; nothing is written over");
}

}  // namespace darkling
