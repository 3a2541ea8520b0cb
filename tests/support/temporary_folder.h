// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace darkling::test {

// A new, empty folder that goes with all it holds.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  // Without a slash at its end.
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string operator/(std::string_view name) const {
    return path_ + "/" + std::string(name);
  }

 private:
  std::string path_;
};

// Small edits to files, for tests of bad input. Each throws when it cannot be done, so that no test
// passes on an edit that did not happen.

// Makes the folders above `path` too.
void write_text(const std::string& path, std::string_view content);
[[nodiscard]] std::string read_text(const std::string& path);
// Replaces the first `from`, which must be there.
void replace_in_file(const std::string& path, std::string_view from, std::string_view to);
void truncate_file(const std::string& path, double kept_fraction);
// Inverts the byte in the middle of the file.
void flip_middle_byte(const std::string& path);
void remove_path(const std::string& path);

}  // namespace darkling::test
