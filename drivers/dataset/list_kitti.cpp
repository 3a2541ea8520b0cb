// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "base/text_file.h"
#include "drivers/dataset/dataset_rows.h"

namespace darkling {

namespace {

namespace fs = std::filesystem;

Result<std::vector<std::string>> list_images(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string suffix = entry.path().extension().string();
    const bool is_image = suffix == ".png" || suffix == ".jpg" || suffix == ".jpeg";
    if (is_image) names.push_back(entry.path().filename().string());
  }
  if (error) return failure(ExitCode::kNoInput, folder + ": " + error.message());
  if (names.empty()) return failure(ExitCode::kNoInput, folder + ": holds no *.png or *.jpg");
  std::sort(names.begin(), names.end());
  return names;
}

Result<std::vector<FrameTime>> read_times(const std::string& path) {
  constexpr double kMaxSeconds = 9e9;  // in nanoseconds it still fits 64 bits
  const auto lines = read_text_lines(path);
  if (!lines) {
    return failure(lines.error().code,
                   lines.error().message + "; it holds the time of each image in seconds");
  }
  std::vector<FrameTime> times;
  for (const TextLine& line : *lines) {
    const auto seconds = parse_number<double>(line.text);
    if (!seconds || !(std::abs(*seconds) < kMaxSeconds)) {
      return failure(ExitCode::kBadInput, at_line(path, line.number) + "found '" + line.text +
                                              "', one time in seconds is needed");
    }
    times.push_back(frame_time_from_ns(std::llround(*seconds * 1e9)));
  }
  return times;
}

// Both eyes hold images of the same names, or the copy is not complete.
Result<void> check_same_names(const std::string& folder, const std::vector<std::string>& left,
                              const std::vector<std::string>& right) {
  if (left == right) return {};
  std::vector<std::string> alone;
  std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(),
                                std::back_inserter(alone));
  const bool is_left = std::binary_search(left.begin(), left.end(), alone.front());
  return failure(ExitCode::kBadInput, folder + ": image_0 holds " + std::to_string(left.size()) +
                                          " images and image_1 " + std::to_string(right.size()) +
                                          "; " + alone.front() + " is only in " +
                                          (is_left ? "image_0" : "image_1") +
                                          ". Is the copy complete?");
}

// The name as a row number, or nothing: 000123.png is 123.
std::optional<std::int64_t> number_of(const std::string& name) {
  return parse_number<std::int64_t>(fs::path(name).stem().string());
}

DatasetRow make_row(const std::string& folder, std::int64_t sequence, const std::string& name,
                    FrameTime stamp) {
  return {.sequence = sequence,
          .stamp = stamp,
          .left_path = folder + "/image_0/" + name,
          .right_path = folder + "/image_1/" + name};
}

// A folder that holds some of the recording's images: their names say which.
std::optional<std::vector<DatasetRow>> rows_by_number(const std::string& folder,
                                                      const std::vector<std::string>& names,
                                                      const std::vector<FrameTime>& times) {
  std::vector<DatasetRow> rows;
  for (const std::string& name : names) {
    const auto number = number_of(name);
    if (!number || *number < 0 || *number >= static_cast<std::int64_t>(times.size())) return {};
    if (!rows.empty() && *number <= rows.back().sequence) return {};
    while (!rows.empty() && rows.back().sequence + 1 < *number) {
      const std::int64_t missing = rows.back().sequence + 1;
      rows.push_back(make_row(folder, missing, "absent (" + std::to_string(missing) + ")",
                              times[static_cast<std::size_t>(missing)]));
    }
    rows.push_back(make_row(folder, *number, name, times[static_cast<std::size_t>(*number)]));
  }
  return rows;
}

}  // namespace

Result<std::vector<DatasetRow>> list_kitti_rows(const std::string& folder) {
  const auto left = list_images(folder + "/image_0");
  if (!left) return tl::unexpected(left.error());
  const auto right = list_images(folder + "/image_1");
  if (!right) return tl::unexpected(right.error());
  if (auto same = check_same_names(folder, *left, *right); !same) {
    return tl::unexpected(same.error());
  }
  const auto times = read_times(folder + "/times.txt");
  if (!times) return tl::unexpected(times.error());
  if (times->size() > left->size()) {
    if (auto rows = rows_by_number(folder, *left, *times)) return *rows;
  }
  if (times->size() != left->size()) {
    return failure(ExitCode::kBadInput, folder + ": times.txt has " +
                                            std::to_string(times->size()) + " lines for " +
                                            std::to_string(left->size()) +
                                            " pairs of images; one line a pair is needed");
  }
  std::vector<DatasetRow> rows;
  for (std::size_t i = 0; i < left->size(); ++i) {
    rows.push_back(make_row(folder, static_cast<std::int64_t>(i), (*left)[i], (*times)[i]));
  }
  return rows;
}

}  // namespace darkling
