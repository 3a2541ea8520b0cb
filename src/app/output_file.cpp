// SPDX-License-Identifier: Apache-2.0
#include "app/output_file.h"

#include <cerrno>
#include <cstring>

namespace darkling {

Result<OutputFile> OutputFile::open(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "we");
  if (file == nullptr) {
    return failure(ExitCode::kUsage,
                   path + ": cannot be opened for writing: " + std::strerror(errno));
  }
  return OutputFile(path, file);
}

void OutputFile::append(std::string_view lines) {
  const bool is_written = std::fwrite(lines.data(), 1, lines.size(), file_.get()) == lines.size() &&
                          std::fflush(file_.get()) == 0;
  if (!is_written && error_number_ == 0) error_number_ = errno;
}

Result<void> OutputFile::close() {
  if (std::fclose(file_.release()) != 0 && error_number_ == 0) error_number_ = errno;
  if (error_number_ == 0) return {};
  return failure(ExitCode::kUsage, path_ + ": is incomplete: " + std::strerror(error_number_));
}

}  // namespace darkling
