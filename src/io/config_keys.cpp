// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <type_traits>
#include <utility>

#include "io/config.h"
#include "vo/limits.h"

namespace darkling {

namespace {

template <auto Part, auto Member>
using MemberType = std::remove_cvref_t<decltype(std::declval<Config>().*Part.*Member)>;

template <auto Part, auto Member>
constexpr Field<MemberType<Part, Member>> member() {
  using T = MemberType<Part, Member>;
  return {[](const Config& config) -> const T& { return config.*Part.*Member; },
          [](Config& config) -> T& { return config.*Part.*Member; }};
}

template <auto Part, auto Member>
constexpr WordField one_of(std::span<const std::string_view> words) {
  using Enumeration = MemberType<Part, Member>;
  return {
      words,
      [](const Config& config) { return static_cast<std::size_t>(config.*Part.*Member); },
      [](Config& config, std::size_t word) {
        config.*Part.*Member = static_cast<Enumeration>(word);
      },
  };
}

constexpr auto kOdometry = &Config::odometry;
constexpr auto kCamera = &Config::camera;
constexpr auto kService = &Config::service;
using O = OdometryConfig;
using K = CameraConfig;
using S = ServiceConfig;

// In the order of their enumerations.
constexpr std::array kDescriptorWords = std::to_array<std::string_view>({"bitplanes", "intensity"});
constexpr std::array kStereoWords = std::to_array<std::string_view>({"semi_global", "block"});
constexpr std::array kLayoutWords =
    std::to_array<std::string_view>({"two_devices", "side_by_side", "top_bottom"});
constexpr std::array kFormatWords =
    std::to_array<std::string_view>({"any", "grey", "y10", "y10p", "y12", "y16", "yuyv", "uyvy",
                                     "nv12", "bayer", "rgb", "bgr", "mjpeg"});

// name, unit, least, most, field, what it is, whether 0 is allowed besides, limits' names.
constexpr std::array kKeys = std::to_array<ConfigKey>({
    {"width_px", "px", kMinWidth, kMaxWidth, member<kOdometry, &O::width_px>(),
     "Width of the thumbnail that is tracked; its height follows. 0 is the source's width.",
     /*may_be_zero=*/true, "kMinWidth, kMaxWidth"},
    {"points_per_level", "", kMinPointsPerLevel, kMaxPointsPerLevel,
     member<kOdometry, &O::points_per_level>(),
     "Most points the template holds on the finest level of the pyramid, and half as many on each "
     "coarser one; bounds the time of a frame.",
     /*may_be_zero=*/false, "kMinPointsPerLevel, kMaxPointsPerLevel"},
    {"descriptor", "", 0, 0, one_of<kOdometry, &O::descriptor>(kDescriptorWords),
     "What is compared between images: bitplanes are the signs of differences of brightness, which "
     "no exposure changes; intensity is brightness itself and is there to compare with."},
    {"stereo", "", 0, 0, one_of<kOdometry, &O::stereo>(kStereoWords),
     "How a keyframe's disparities are found: semi_global lets neighbours agree, block takes the "
     "least cost of each window by itself and is there to compare with."},
    {"refinement", "", 0, 0, member<kOdometry, &O::refinement>(),
     "Whether the last keyframes and their points are refined together, and new keyframes start "
     "from the depths found so."},
    {"window_keyframes", "", kMinWindowKeyframes, kMaxWindowKeyframes,
     member<kOdometry, &O::window_keyframes>(), "How many keyframes are refined together.",
     /*may_be_zero=*/false, "kMinWindowKeyframes, kMaxWindowKeyframes"},
    {"window_points", "", kMinWindowPoints, kMaxWindowPoints,
     member<kOdometry, &O::window_points>(), "Most points of each keyframe that are refined.",
     /*may_be_zero=*/false, "kMinWindowPoints, kMaxWindowPoints"},

    {"camera", "v4l2:DEVICE[,DEVICE], libcamera:ID[,ID], synthetic:SCENE or a frame log", 0, 0,
     member<kCamera, &K::source>(),
     "Where the service takes its frames from: one device that delivers both eyes, two devices "
     "left "
     "and right, or what stands in for them without hardware."},
    {"calibration", "a file or folder", 0, 0, member<kService, &S::calibration>(),
     "Calibration of the cameras: Kalibr camchain, OpenCV stereo YAML, ROS camera_info or EuRoC "
     "sensor.yaml; synthetic scenes and frame logs bring their own."},
    {"layout", "", 0, 0, one_of<kCamera, &K::layout>(kLayoutWords),
     "How the two eyes arrive: from two devices, or in one image."},
    {"swap_eyes", "", 0, 0, member<kCamera, &K::swap_eyes>(),
     "Whether what arrives as left is the right eye."},
    {"pixel_format", "", 0, 0, one_of<kCamera, &K::format>(kFormatWords),
     "What the device is asked for; any takes the first it offers of those listed."},
    {"camera_width_px", "px", 16, 8192, member<kCamera, &K::width_px>(),
     "Width of the device's image, both eyes of a shared one together; 0 is the calibration's.",
     /*may_be_zero=*/true},
    {"camera_height_px", "px", 16, 8192, member<kCamera, &K::height_px>(),
     "Height of the device's image; 0 is the calibration's.", /*may_be_zero=*/true},
    {"rate_hz", "Hz", 1, 240, member<kCamera, &K::rate_hz>(), "Pairs a second."},
    {"exposure_ms", "ms", 0.01, 1000, member<kCamera, &K::exposure_ms>(),
     "Exposure of both eyes; 0 leaves it to the camera.", /*may_be_zero=*/true},
    {"max_exposure_ms", "ms", 0.01, 1000, member<kCamera, &K::max_exposure_ms>(),
     "Most exposure, against motion blur, where the camera can be told."},
    {"gain", "device's own", 1, 65535, member<kCamera, &K::gain>(),
     "Gain of both eyes; 0 leaves it to the camera.", /*may_be_zero=*/true},
    {"max_skew_ms", "ms", 0, 100, member<kCamera, &K::max_skew_ms>(),
     "Most that the two eyes of a pair may be apart in time."},

    {"lcm_url", "udpm://GROUP:PORT?ttl=N", 0, 0, member<kService, &S::lcm_url>(),
     "Where messages are published; with ttl=0 they stay on this machine."},
    {"channel_prefix", "text of up to 53 characters", 0, 53, member<kService, &S::channel_prefix>(),
     "Put before the name of every channel, published or listened to."},
    {"bot_core_pose", "", 0, 0, member<kService, &S::bot_core_pose>(),
     "Whether the pose is published as bot_core.pose_t too, on the channel POSE."},
    {"record_to", "a folder", 0, 0, member<kService, &S::record_to>(),
     "Where frame logs are written; empty: nowhere, none is made."},
    {"record", "", 0, 0, member<kService, &S::record>(),
     "Whether to record from the start, without waiting for a command."},
    {"record_limit_mb", "MB", 1, 1000000, member<kService, &S::record_limit_mb>(),
     "Size at which a frame log ends."},
    {"black_box_s", "s", 1, 60, member<kService, &S::black_box_s>(),
     "How much of the past is kept in memory and written to record_to when tracking is lost; 0 is "
     "none.",
     /*may_be_zero=*/true},
    {"realtime_priority", "", 1, 99, member<kService, &S::realtime_priority>(),
     "SCHED_FIFO priority of the thread that takes frames from the camera; 0 is none.",
     /*may_be_zero=*/true},
    {"cpu", "", -1, 1023, member<kService, &S::cpu>(),
     "Core that the odometry stays on; -1 is any."},
    {"lock_memory", "", 0, 0, member<kService, &S::lock_memory>(),
     "Whether to keep all memory from being paged out."},
});

}  // namespace

std::span<const ConfigKey> config_keys() {
  return kKeys;
}

}  // namespace darkling
