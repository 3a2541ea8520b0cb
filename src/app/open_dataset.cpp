// SPDX-License-Identifier: Apache-2.0
#include "app/open_dataset.h"

#include <filesystem>

#include "drivers/dataset/dataset_source.h"
#include "io/calibration.h"

namespace darkling {

namespace {

namespace fs = std::filesystem;

bool exists(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

std::string name_of(const std::string& folder) {
  std::error_code error;
  const fs::path full = fs::weakly_canonical(folder, error);
  return error ? folder : full.filename().string();
}

// The first of `paths` that exists, or empty.
std::string first_that_exists(std::initializer_list<std::string> paths) {
  for (const std::string& path : paths) {
    if (exists(path)) return path;
  }
  return {};
}

// The selected rows of `rows`, or why there are none.
Result<std::vector<DatasetRow>> select(const std::string& folder,
                                       const std::vector<DatasetRow>& rows,
                                       const OpenOptions& options) {
  std::vector<DatasetRow> selected =
      select_rows(rows, {.first = options.first, .last = options.last, .stride = options.stride});
  if (!selected.empty()) return selected;
  return failure(ExitCode::kUsage, folder + ": frames from " + std::to_string(options.first) +
                                       " on are asked for, it holds frames 0 to " +
                                       std::to_string(rows.size() - 1));
}

// @param rows  of the whole recording.
Result<ImageSize> size_of_images(const std::string& folder, const std::vector<DatasetRow>& rows) {
  auto size = first_pair_size(rows);
  if (!size) return failure(size.error().code, folder + ": " + size.error().message);
  return size;
}

void play(std::vector<DatasetRow> rows, ImageSize size, Recording& recording) {
  recording.frame_count = static_cast<std::int64_t>(rows.size());
  recording.source = std::make_unique<DatasetSource>(std::move(rows), size);
}

Result<StereoRig> load_chosen(const EurocCalibrationChoice& choice) {
  return choice.is_kalibr ? load_kalibr_calibration(choice.path)
                          : load_euroc_calibration(choice.path);
}

}  // namespace

std::optional<DatasetLayout> recognise_layout(const std::string& folder) {
  if (exists(folder + "/mav0")) return DatasetLayout::kEuroc;
  const bool has_images = exists(folder + "/image_0") || exists(folder + "/image_1") ||
                          exists(folder + "/image_2") || exists(folder + "/image_3");
  if (has_images || exists(folder + "/calib.txt")) return DatasetLayout::kKitti;
  return std::nullopt;
}

Result<Recording> open_kitti(const std::string& folder, const OpenOptions& options) {
  for (const char* eye : {"/image_0", "/image_1"}) {
    if (exists(folder + eye)) continue;
    std::string message = folder + ": has no " + (eye + 1) +
                          "; image_0 (left) and image_1 (right) of the grey cameras are needed";
    if (exists(folder + "/image_2")) message += ", image_2 and image_3 are the colour cameras";
    return failure(ExitCode::kNoInput, message);
  }
  const auto rows = list_kitti_rows(folder);
  if (!rows) return tl::unexpected(rows.error());
  auto selected = select(folder, *rows, options);
  if (!selected) return tl::unexpected(selected.error());
  const auto size = size_of_images(folder, *rows);
  if (!size) return tl::unexpected(size.error());
  Recording recording;
  recording.name = name_of(folder);
  recording.kind = "KITTI";
  recording.calibration_path = folder + "/calib.txt";
  recording.truth_path = first_that_exists({folder + "/poses.txt"});
  const auto rig = load_kitti_calibration(recording.calibration_path, size->width, size->height);
  if (!rig) return tl::unexpected(rig.error());
  recording.rig = *rig;
  play(std::move(*selected), *size, recording);
  return recording;
}

Result<Recording> open_euroc(const std::string& folder, const OpenOptions& options) {
  const std::string mav0 = folder + "/mav0";
  for (const char* eye : {"/cam0", "/cam1"}) {
    if (exists(mav0 + eye + "/data.csv")) continue;
    return failure(ExitCode::kNoInput, mav0 + eye +
                                           "/data.csv: not found; mav0 needs cam0 (left) "
                                           "and cam1 (right), each with data.csv and "
                                           "data/*.png");
  }
  const auto rows = list_euroc_rows(mav0);
  if (!rows) return tl::unexpected(rows.error());
  auto selected = select(folder, *rows, options);
  if (!selected) return tl::unexpected(selected.error());
  const auto choice = choose_euroc_calibration(folder);
  if (!choice) return tl::unexpected(choice.error());
  Recording recording;
  recording.name = name_of(folder);
  recording.kind = "EuRoC";
  recording.calibration_path =
      choice->is_kalibr ? choice->path : choice->path + "/cam0/sensor.yaml";
  recording.truth_path = first_that_exists(
      {mav0 + "/state_groundtruth_estimate0/data.csv", folder + "/groundtruth.tum"});
  const auto rig = load_chosen(*choice);
  if (!rig) return tl::unexpected(rig.error());
  recording.rig = *rig;
  const auto size = size_of_images(folder, *rows);
  if (!size) return tl::unexpected(size.error());
  const ImageSize calibrated{rig->left.width, rig->left.height};
  if (*size != calibrated) {
    return failure(ExitCode::kConfiguration,
                   folder + ": the images are " + to_text(*size) + " px, the calibration in " +
                       recording.calibration_path + " is for " + to_text(calibrated) + " px");
  }
  play(std::move(*selected), *size, recording);
  return recording;
}

}  // namespace darkling
