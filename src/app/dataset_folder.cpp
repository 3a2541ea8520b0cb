// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <exception>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>

#include "app/dataset_writer.h"

namespace darkling {

namespace fs = std::filesystem;

namespace {

// All that a dataset of either layout consists of.
constexpr std::array kDatasetParts = {"mav0",      "groundtruth.tum", "image_0",  "image_1",
                                      "calib.txt", "times.txt",       "poses.txt"};

}  // namespace

Result<void> make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error) return {};
  return failure(ExitCode::kUsage, path + ": the folder cannot be made: " + error.message());
}

Result<void> remove_file(const std::string& path) {
  std::error_code error;
  fs::remove(path, error);
  if (!error) return {};
  return failure(ExitCode::kUsage, path + ": cannot be removed: " + error.message());
}

Result<void> prepare_folder(const std::string& folder, bool is_forced) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    return failure(ExitCode::kUsage,
                   folder + ": is not a folder; name one that is empty or absent");
  }
  if (fs::exists(status) && is_forced) {
    for (const char* part : kDatasetParts) {
      fs::remove_all(folder + "/" + part, error);
      if (error) {
        return failure(ExitCode::kUsage,
                       folder + "/" + part + ": cannot be removed: " + error.message());
      }
    }
  } else if (fs::exists(status)) {
    const bool is_empty = fs::is_empty(folder, error);
    if (error) {
      return failure(ExitCode::kUsage, folder + ": cannot be read: " + error.message());
    }
    if (!is_empty) {
      return failure(ExitCode::kUsage,
                     folder +
                         ": is not empty; name a new folder, or add --force to write over the "
                         "dataset in it");
    }
  }
  return make_folder(folder);
}

Result<void> write_png(const std::string& path, const ImageView<const std::uint8_t>& image) {
  const cv::Mat pixels(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data),
                       static_cast<std::size_t>(image.stride));
  std::string reason = "is the disk full?";
  try {
    // Fast rather than small: noise does not compress.
    if (cv::imwrite(path, pixels, {cv::IMWRITE_PNG_COMPRESSION, 1})) return {};
  } catch (const std::exception& e) {
    reason = e.what();
  }
  return failure(ExitCode::kUsage, path + ": the image cannot be written: " + reason);
}

}  // namespace darkling
