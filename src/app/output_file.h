// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"

namespace darkling {

// A text file that is written line by line: each line has left the process when append() returns,
// so that the file is whole whatever happens next.
class OutputFile {
 public:
  // Creates or empties `path`. @return kUsage with the system's reason.
  [[nodiscard]] static Result<OutputFile> open(const std::string& path);

  // @param lines  whole lines. A failure is remembered for close().
  void append(std::string_view lines);
  // @return kUsage when anything could not be written.
  [[nodiscard]] Result<void> close();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  OutputFile(std::string path, std::FILE* file) : path_(std::move(path)), file_(file) {}

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  int error_number_ = 0;
};

}  // namespace darkling
