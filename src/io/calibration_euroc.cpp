// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "io/calibration.h"
#include "io/calibration_yaml.h"

namespace darkling {

namespace {

namespace fs = std::filesystem;

struct MountedCamera {
  Camera camera;
  Se3 T_body_camera;
};

Result<MountedCamera> read_sensor(const std::string& path) {
  const auto section = read_yaml_file(path);
  if (!section) return tl::unexpected(section.error());
  const auto camera = yaml_camera(*section, "distortion_coefficients");
  if (!camera) return tl::unexpected(camera.error());
  const auto T_body_camera = yaml_motion(*section, "T_BS");
  if (!T_body_camera) return tl::unexpected(T_body_camera.error());
  return MountedCamera{*camera, *T_body_camera};
}

// Whether a sensor.yaml calibrates a camera; one that cannot be parsed counts, so that its error is
// told instead of passed over.
bool has_intrinsics(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return false;
  const auto section = read_yaml_file(path);
  return !section || has_key(*section, "intrinsics");
}

std::vector<std::string> find_camchains(const fs::path& folder) {
  std::vector<std::string> found;
  for (const fs::path& place : {folder, folder / "dso", folder / "mav0"}) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(place, error)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("camchain") && name.ends_with(".yaml")) {
        found.push_back(entry.path().string());
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

Result<StereoRig> load_euroc_calibration(const std::string& mav0_folder) {
  const auto left = read_sensor(mav0_folder + "/cam0/sensor.yaml");
  if (!left) return tl::unexpected(left.error());
  const auto right = read_sensor(mav0_folder + "/cam1/sensor.yaml");
  if (!right) return tl::unexpected(right.error());
  const StereoRig rig{.left = left->camera,
                      .right = right->camera,
                      .T_body_rawleft = left->T_body_camera,
                      .T_body_rawright = right->T_body_camera};
  if (auto checked = check_rig(rig); !checked) {
    return failure(checked.error().code,
                   mav0_folder + "/cam{0,1}/sensor.yaml: " + checked.error().message);
  }
  return rig;
}

bool has_camchain(const std::string& folder) {
  return !find_camchains(folder).empty();
}

Result<EurocCalibrationChoice> choose_euroc_calibration(const std::string& folder) {
  const std::string mav0 = folder + "/mav0";
  const bool have_sensors =
      has_intrinsics(mav0 + "/cam0/sensor.yaml") && has_intrinsics(mav0 + "/cam1/sensor.yaml");
  if (have_sensors) return EurocCalibrationChoice{.path = mav0, .is_kalibr = false};
  const std::vector<std::string> camchains = find_camchains(folder);
  const auto plain = std::find_if(camchains.begin(), camchains.end(), [](const std::string& path) {
    return fs::path(path).filename() == "camchain.yaml";
  });
  if (camchains.size() == 1) {
    return EurocCalibrationChoice{.path = camchains.front(), .is_kalibr = true};
  }
  if (plain != camchains.end()) return EurocCalibrationChoice{.path = *plain, .is_kalibr = true};
  if (camchains.empty()) {
    return failure(
        ExitCode::kConfiguration,
        folder +
            ": no calibration: looked for mav0/cam0/sensor.yaml and "
            "mav0/cam1/sensor.yaml with intrinsics, and for camchain*.yaml here, in dso/ "
            "and in mav0/");
  }
  std::string message = folder + ": which calibration is meant? Keep one of";
  for (const std::string& path : camchains) message += "\n  " + path;
  return failure(ExitCode::kConfiguration, message);
}

}  // namespace darkling
