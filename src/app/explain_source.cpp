// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "app/open_dataset.h"
#include "base/nearest.h"

namespace darkling {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRecognised =
    "\nRecognised are"
    "\n  a KITTI folder: image_0/ image_1/ calib.txt times.txt"
    "\n  an EuRoC folder: mav0/cam0/data.csv mav0/cam1/data.csv, calibrated by sensor.yaml files or"
    "\n    a camchain.yaml"
    "\n  a frame log: NAME.lcmlog, as `darkling convert` writes it"
    "\n  synthetic:SCENE[,key=value...]";

// The folder above `path` that is a recording, at most four up: a camera's images lie three deep.
std::optional<std::string> find_above(const fs::path& path) {
  std::error_code error;
  fs::path folder = fs::weakly_canonical(path, error);
  for (int i = 0; i < 4 && !error && folder.has_relative_path(); ++i) {
    folder = folder.parent_path();
    if (recognise_layout(folder.string())) return folder.string();
  }
  return std::nullopt;
}

// The recordings among the folders of `path`, by name.
std::vector<std::string> find_below(const fs::path& path) {
  std::vector<std::string> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (recognise_layout(entry.path().string())) found.push_back(entry.path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

// The neighbour of a path that does not exist whose name is most like it.
std::optional<std::string> find_beside(const fs::path& path) {
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, error)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string wanted = path.filename().string();
  if (const auto nearest = nearest_name(wanted, views)) {
    return path.has_parent_path() ? (parent / *nearest).string() : std::string(*nearest);
  }
  return std::nullopt;
}

Error explain_absent(const std::string& path) {
  std::string message = path + ": no such file or folder";
  if (const auto nearest = find_beside(path)) {
    message += ", did you mean " + *nearest + "?";
  } else {
    message += kRecognised;
  }
  return {ExitCode::kNoInput, message};
}

Error explain_folder(const std::string& path) {
  const std::vector<std::string> below = find_below(path);
  if (below.empty()) {
    return {ExitCode::kBadInput, path +
                                     ": is neither a KITTI folder (no image_0, image_1 or "
                                     "calib.txt in it) nor an EuRoC folder (no mav0 in it)" +
                                     kRecognised};
  }
  std::string message =
      path + ": is no recording itself, but holds " + std::to_string(below.size()) + "; name one:";
  constexpr std::size_t kMaxNamed = 10;
  for (std::size_t i = 0; i < std::min(below.size(), kMaxNamed); ++i) message += "\n  " + below[i];
  if (below.size() > kMaxNamed) message += "\n  ...";
  return {ExitCode::kBadInput, message};
}

}  // namespace

Error explain_unknown_source(const std::string& path) {
  if (path.empty()) {
    return {ExitCode::kUsage, std::string("the name of the source is empty") + kRecognised};
  }
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return explain_absent(path);
  if (error) return {ExitCode::kNoInput, path + ": " + error.message()};
  if (const auto above = find_above(path)) {
    return {ExitCode::kBadInput, path + ": is a part of a recording, did you mean " + *above + "?"};
  }
  if (!fs::is_directory(status)) {
    return {ExitCode::kBadInput, path + ": is a file, no recording" + kRecognised};
  }
  const bool is_empty = fs::is_empty(path, error);
  if (error) return {ExitCode::kNoInput, path + ": " + error.message()};
  if (is_empty) return {ExitCode::kNoInput, path + ": is an empty folder" + kRecognised};
  return explain_folder(path);
}

}  // namespace darkling
