// SPDX-License-Identifier: Apache-2.0
#include "base/text_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace darkling {

namespace {

constexpr std::string_view kWhiteSpace = " \t\r\n\v\f";

}  // namespace

Result<std::vector<TextLine>> read_text_lines(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return failure(ExitCode::kNoInput, path + ": is a folder, a text file is needed");
  }
  std::ifstream file(path);
  if (!file) return failure(ExitCode::kNoInput, path + ": " + std::strerror(errno));
  std::vector<TextLine> lines;
  std::string text;
  for (int number = 1; std::getline(file, text); ++number) {
    const std::string_view trimmed = trim(text);
    if (trimmed.empty() || trimmed.front() == '#') continue;
    lines.push_back({number, std::string(trimmed)});
  }
  if (file.bad()) return failure(ExitCode::kNoInput, path + ": cannot be read to its end");
  return lines;
}

std::string at_line(const std::string& path, int line) {
  return path + ":" + std::to_string(line) + ": ";
}

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kWhiteSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kWhiteSpace) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  const bool at_white_space = separator == ' ';
  const std::string_view separators =
      at_white_space ? kWhiteSpace : std::string_view(&separator, 1);
  std::vector<std::string_view> pieces;
  for (;;) {
    const std::size_t end = text.find_first_of(separators);
    const std::string_view piece = trim(text.substr(0, end));
    if (!at_white_space || !piece.empty()) pieces.push_back(piece);
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + 1);
  }
}

}  // namespace darkling
