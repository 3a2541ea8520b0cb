// SPDX-License-Identifier: Apache-2.0
#include "support/recordings.h"

#include <cstdlib>
#include <filesystem>

namespace darkling::test {

std::string data_folder() {
  if (const char* folder = std::getenv("DARKLING_DATA"); folder != nullptr && *folder != '\0') {
    return folder;
  }
  const std::filesystem::path project = DARKLING_PROJECT_DIR;
  return (project.parent_path() / "shared" / "data").string();
}

std::string recording_folder(const std::string& name) {
  const std::string folder = data_folder() + "/" + name;
  return std::filesystem::is_directory(folder) ? folder : std::string();
}

}  // namespace darkling::test
