// SPDX-License-Identifier: Apache-2.0
#include "support/temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <stdlib.h>

namespace darkling::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  path_ = (fs::temp_directory_path() / "darkling-test-XXXXXX").string();
  if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder " + path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void write_text(const std::string& path, std::string_view content) {
  if (const fs::path parent = fs::path(path).parent_path(); !parent.empty()) {
    fs::create_directories(parent);
  }
  std::ofstream file(path, std::ios::binary);
  file << content;
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (file.peek() != std::ifstream::traits_type::eof()) content << file.rdbuf();  // or it is empty
  if (!file.is_open() || file.bad() || !content) throw std::runtime_error("cannot read " + path);
  return content.str();
}

void replace_in_file(const std::string& path, std::string_view from, std::string_view to) {
  std::string content = read_text(path);
  const std::size_t at = content.find(from);
  if (at == std::string::npos) {
    throw std::runtime_error(path + " does not hold '" + std::string(from) + "'");
  }
  write_text(path, content.replace(at, from.size(), to));
}

void truncate_file(const std::string& path, double kept_fraction) {
  const auto bytes = static_cast<double>(fs::file_size(path));
  fs::resize_file(path, static_cast<std::uintmax_t>(bytes * kept_fraction));
}

void flip_middle_byte(const std::string& path) {
  std::string content = read_text(path);
  char& middle = content.at(content.size() / 2);
  middle = static_cast<char>(~middle);
  write_text(path, content);
}

void remove_path(const std::string& path) {
  if (fs::remove_all(path) == 0) throw std::runtime_error("nothing to remove at " + path);
}

}  // namespace darkling::test
