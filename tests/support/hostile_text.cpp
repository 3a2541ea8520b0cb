// SPDX-License-Identifier: Apache-2.0
#include "support/hostile_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "drivers/injection/injection.h"
#include "drivers/libcamera/libcamera_spec.h"
#include "drivers/synthetic/synthetic_spec.h"
#include "drivers/v4l2/v4l2_spec.h"
#include "geometry/stereo_rig.h"
#include "io/calibration.h"
#include "io/config.h"
#include "io/decimal_time.h"
#include "io/evaluate.h"
#include "support/calibration_texts.h"
#include "support/memory_file.h"
#include "support/require.h"
#include "support/temporary_folder.h"

namespace darkling::test {

namespace {

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// @return whether it was accepted.
template <class T>
bool is_accepted(const Result<T>& result, ExitCode refusal) {
  if (result) return true;
  require(!result.error().message.empty(), "a refusal has a reason");
  require(result.error().code == refusal, "a refusal has the exit code that it should");
  return false;
}

// How the files of a calibration lie, one after the other by the first byte of an input.
enum class Lie { kFile, kRos, kOpencv, kEuroc, kCount };

bool is_accepted_injection(std::string_view text) {
  const auto injection = parse_injection(text);
  if (!is_accepted(injection, ExitCode::kUsage)) return false;
  require(injection->kind != nullptr && injection->first < injection->last,
          "an injection is of a kind and has a time");
  require(std::isfinite(injection->value), "its value is a number");
  require(injection->kind->make(*injection) != nullptr, "it can be made");
  return true;
}

bool is_accepted_scene(std::string_view text) {
  const auto spec = parse_synthetic(text);
  if (!is_accepted(spec, ExitCode::kUsage)) return false;
  SyntheticSpec again = *spec;
  require(check_synthetic(again).has_value(), "a scene that is accepted is accepted again");
  require(spec->width > 0 && spec->height > 0 && spec->frames > 0, "and is of some size");
  return true;
}

bool are_accepted_names(const Result<std::vector<std::string>>& names) {
  if (!is_accepted(names, ExitCode::kUsage)) return false;
  require(names->size() == 1 || (names->size() == 2 && names->at(0) != names->at(1)),
          "a rig is one camera or two");
  require(std::none_of(names->begin(), names->end(), [](const auto& name) { return name.empty(); }),
          "each of which has a name");
  return true;
}

bool is_accepted_setting(std::string_view text) {
  const auto config = load_config("", {{"--set", std::string(text)}});
  return is_accepted(config, ExitCode::kUsage);
}

bool is_accepted_time(std::string_view text) {
  const auto ns = ns_from_seconds_text(text);
  if (!ns) return false;
  require(ns_from_seconds_text(seconds_text_from_ns(*ns)) == ns, "times are read as written");
  return true;
}

}  // namespace

bool load_any_config(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  const auto config = load_config(file.path(), {});
  if (!is_accepted(config, ExitCode::kConfiguration)) return false;
  const std::string written = format_config(*config);
  const MemoryFile copy(std::as_bytes(std::span(written)));
  const auto again = load_config(copy.path(), {});
  require(again.has_value() && format_config(*again) == written, "it is read back as itself");
  return true;
}

bool load_any_calibration(std::span<const std::byte> bytes) {
  static const TemporaryFolder folder;
  if (bytes.empty()) return false;
  const auto lie =
      static_cast<Lie>(static_cast<int>(bytes.front()) % static_cast<int>(Lie::kCount));
  const std::string_view text = text_of(bytes.subspan(1));
  const std::size_t zero = std::min(text.find('\0'), text.size());
  const std::string_view first = text.substr(0, zero);
  const std::string_view second = text.substr(std::min(zero + 1, text.size()));
  std::string path;
  switch (lie) {
    case Lie::kFile:
    case Lie::kCount:
      path = folder / "file/calibration.yaml";
      write_text(path, text);
      break;
    case Lie::kRos:
      path = folder / "ros";
      write_text(path + "/left.yaml", first);
      write_text(path + "/right.yaml", second);
      break;
    case Lie::kOpencv:
      path = folder / "opencv";
      write_text(path + "/intrinsics.yml", first);
      write_text(path + "/extrinsics.yml", second);
      break;
    case Lie::kEuroc:
      path = folder / "euroc";
      write_text(path + "/mav0/cam0/sensor.yaml", first);
      write_text(path + "/mav0/cam1/sensor.yaml", second);
      break;
  }
  const auto rig = load_calibration(path, ImageSize{.width = 640, .height = 480});
  if (!is_accepted(rig, ExitCode::kConfiguration)) return false;
  require(check_rig(*rig).has_value(), "a rig that is accepted can be");
  return true;
}

std::size_t read_any_trajectory(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  const auto trajectory = read_trajectory(file.path());
  if (!is_accepted(trajectory, ExitCode::kBadInput)) return 0;
  require(!trajectory->poses.empty(), "a trajectory has poses");
  for (const TimedPose& pose : trajectory->poses) {
    require(pose.T_world_pose.matrix().allFinite(), "poses are numbers");
  }
  static_cast<void>(is_accepted(evaluate(*trajectory, *trajectory), ExitCode::kBadInput));
  return trajectory->poses.size();
}

int understand_any_word(std::span<const std::byte> bytes) {
  const std::string_view text = text_of(bytes);
  int kinds = 0;
  kinds += is_accepted_injection(text) ? 1 : 0;
  kinds += is_accepted_scene(text) ? 1 : 0;
  kinds += are_accepted_names(parse_v4l2(text)) ? 1 : 0;
  kinds += are_accepted_names(parse_libcamera(text)) ? 1 : 0;
  kinds += is_accepted_setting(text) ? 1 : 0;
  kinds += is_accepted_time(text) ? 1 : 0;
  const std::vector<std::string> ids = {"/soc/a/cam@10", "/soc/b/cam@10"};
  kinds += is_accepted(find_camera(std::string(text), ids), ExitCode::kDeviceUnavailable) ? 1 : 0;
  return kinds;
}

}  // namespace darkling::test
