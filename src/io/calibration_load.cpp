// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <exception>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/text_file.h"
#include "io/calibration.h"
#include "io/calibration_yaml.h"

namespace darkling {

namespace {

namespace fs = std::filesystem;

constexpr const char* kKnown =
    "a Kalibr camchain (cam0, cam1), EuRoC sensor.yaml (mav0/cam0, mav0/cam1), a KITTI calib.txt "
    "(P0, P1), OpenCV stereo YAML (M1, D1, M2, D2, R, T) or ROS camera_info (left.yaml and "
    "right.yaml, or LEFT,RIGHT)";

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// `name` with either ending, in `folder`; the first one that exists, or empty.
std::string find_yaml(const fs::path& folder, const std::string& name) {
  for (const char* ending : {".yaml", ".yml"}) {
    const fs::path path = folder / (name + ending);
    if (is_there(path)) return path.string();
  }
  return {};
}

Result<StereoRig> load_kitti(const std::string& path, std::optional<ImageSize> size) {
  if (size) return load_kitti_calibration(path, size->width, size->height);
  return failure(ExitCode::kConfiguration,
                 path +
                     ": KITTI's calib.txt does not say the size of the images, and no images are "
                     "at hand that do; name the recording's folder, or write the calibration as "
                     "OpenCV stereo YAML with image_width and image_height");
}

Result<StereoRig> load_euroc_choice(const std::string& folder) {
  const auto choice = choose_euroc_calibration(folder);
  if (!choice) return tl::unexpected(choice.error());
  return choice->is_kalibr ? load_kalibr_calibration(choice->path)
                           : load_euroc_calibration(choice->path);
}

// The parent of `mav0` counts where there is one: a camchain may lie there.
Result<StereoRig> load_mav0(const fs::path& folder) {
  fs::path mav0 = folder;
  if (mav0.filename().empty()) mav0 = mav0.parent_path();  // "…/mav0/"
  if (mav0.filename() == "mav0" && mav0.has_parent_path()) {
    return load_euroc_choice(mav0.parent_path().string());
  }
  return load_euroc_calibration(mav0.string());
}

Result<StereoRig> load_folder(const std::string& path, std::optional<ImageSize> size) {
  const fs::path folder(path);
  if (is_there(folder / "cam0" / "sensor.yaml")) return load_mav0(folder);
  if (is_there(folder / "mav0")) return load_euroc_choice(path);
  const std::string left = find_yaml(folder, "left");
  const std::string right = find_yaml(folder, "right");
  if (!left.empty() && !right.empty()) return load_ros_calibration(left, right);
  const std::string intrinsics = find_yaml(folder, "intrinsics");
  const std::string extrinsics = find_yaml(folder, "extrinsics");
  if (!intrinsics.empty() && !extrinsics.empty()) {
    return load_opencv_calibration(intrinsics, extrinsics, size);
  }
  if (is_there(folder / "calib.txt")) return load_kitti((folder / "calib.txt").string(), size);
  if (has_camchain(path)) return load_euroc_choice(path);
  return failure(ExitCode::kConfiguration,
                 path + ": found a folder without a calibration, allowed is " + kKnown);
}

// "P0: 718.8 0 …": a number follows, where OpenCV's keys of that name have a tag.
bool is_kitti_row(std::string_view line) {
  line = trim(line);
  if (line.size() < 3 || line[0] != 'P' || line[1] < '0' || line[1] > '3' || line[2] != ':') {
    return false;
  }
  const std::vector<std::string_view> words = split(line.substr(3), ' ');
  return !words.empty() && parse_number<double>(words.front()).has_value();
}

bool is_kitti(const std::string& text) {
  const std::vector<std::string_view> lines = split(text, '\n');
  return std::any_of(lines.begin(), lines.end(), is_kitti_row);
}

bool has_any(const YamlSection& section, std::initializer_list<const char*> keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&section](const char* key) { return has_key(section, key); });
}

Result<StereoRig> load_opencv(const std::string& path, bool has_intrinsics, bool has_extrinsics,
                              std::optional<ImageSize> size) {
  const fs::path folder = fs::path(path).parent_path();
  const std::string intrinsics = has_intrinsics ? path : find_yaml(folder, "intrinsics");
  const std::string extrinsics = has_extrinsics ? path : find_yaml(folder, "extrinsics");
  if (!intrinsics.empty() && !extrinsics.empty()) {
    return load_opencv_calibration(intrinsics, extrinsics, size);
  }
  return failure(ExitCode::kConfiguration,
                 path + ": found " +
                     (has_intrinsics ? "M1 and M2 without R and T" : "R and T without M1 and M2") +
                     ", allowed is all in one file, or intrinsics.yml and extrinsics.yml side by "
                     "side");
}

// One camera_info knows where its rectified camera is, not how both are turned: the other is
// needed.
Result<StereoRig> load_ros(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const std::string stem = fs::path(path).stem().string();
  const std::string left = find_yaml(folder, "left");
  const std::string right = find_yaml(folder, "right");
  if ((stem == "left" || stem == "right") && !left.empty() && !right.empty()) {
    return load_ros_calibration(left, right);
  }
  return failure(ExitCode::kConfiguration,
                 path +
                     ": found ROS camera_info of one camera, allowed is that of both: LEFT,RIGHT, "
                     "or a folder of left.yaml and right.yaml");
}

Result<StereoRig> load_file(const std::string& path, std::optional<ImageSize> size) {
  const auto text = read_calibration_text(path);
  if (!text) return tl::unexpected(text.error());
  if (is_kitti(*text)) return load_kitti(path, size);
  const auto section = read_yaml_file(path);
  if (!section) return tl::unexpected(section.error());
  if (has_any(*section, {"cam0", "cam1"})) return load_kalibr_calibration(path);
  const bool has_intrinsics =
      has_any(*section, {"M1", "M2", "K1", "K2", "cameraMatrix1", "cameraMatrix2"});
  const bool has_extrinsics = has_any(*section, {"R", "T"});
  if (has_intrinsics || has_extrinsics) {
    return load_opencv(path, has_intrinsics, has_extrinsics, size);
  }
  if (has_any(*section, {"camera_matrix", "rectification_matrix"})) return load_ros(path);
  const fs::path camera_folder = fs::absolute(path).parent_path();
  if (has_any(*section, {"T_BS"}) && camera_folder.filename().string().starts_with("cam")) {
    return load_mav0(camera_folder.parent_path());
  }
  return failure(ExitCode::kConfiguration,
                 path + ": found none of the keys that calibrations have, allowed is " + kKnown);
}

Result<StereoRig> load_any(const std::string& path, std::optional<ImageSize> size) {
  if (path.empty()) {
    return failure(ExitCode::kConfiguration,
                   std::string("no calibration is named; allowed is ") + kKnown);
  }
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return load_folder(path, size);
  const std::vector<std::string_view> paths = split(path, ',');
  if (paths.size() == 2 && !is_there(path)) {
    return load_ros_calibration(std::string(paths[0]), std::string(paths[1]));
  }
  return load_file(path, size);
}

}  // namespace

Result<StereoRig> load_calibration(const std::string& path, std::optional<ImageSize> size) {
  try {
    return load_any(path, size);
  } catch (const std::exception& e) {
    // Of the file system or of the YAML library, at a file that nobody wrote by hand.
    return failure(ExitCode::kConfiguration,
                   path + ": calibration cannot be read: " + std::string(e.what()));
  }
}

}  // namespace darkling
