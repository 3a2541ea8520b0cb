// SPDX-License-Identifier: Apache-2.0
// write_seeds DIR: what the fuzzers start from, a folder in DIR for each.
#include <array>
#include <cstdio>
#include <string>

#include "io/config.h"
#include "support/calibration_texts.h"
#include "support/jpeg_images.h"
#include "support/message_cases.h"
#include "support/temporary_folder.h"
#include "support/tiny_frame_log.h"

namespace darkling::test {
namespace {

void write_messages(const std::string& folder) {
  for_each_message([&](const auto& message) {
    const std::vector<std::byte> bytes = encoded(message);
    write_text(folder + "/" + message.getTypeName(),
               {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  });
}

void write_configs(const std::string& folder) {
  write_text(folder + "/default.yaml", format_config(Config{}));
  write_text(folder + "/short.yaml", "# a rover\nwidth_px: 177\ncamera: \"v4l2:/dev/video0\"\n");
  write_text(folder + "/anchors.yaml", "? &a cpu\n: 3\nchannel_prefix: !!str |\n  R\n...\n");
}

// The first byte says how the files lie: see load_any_calibration().
void write_calibrations(const std::string& folder) {
  const std::string zero(1, '\0');
  write_text(folder + "/kalibr", zero + kalibr_camchain());
  write_text(folder + "/kitti", zero + kitti_calib());
  const std::string opencv = opencv_intrinsics();
  write_text(folder + "/opencv_file", zero + opencv + opencv_extrinsics().substr(14));
  write_text(folder + "/ros",
             "\1" + ros_camera_info("left", 0.0) + zero + ros_camera_info("right", -60.0));
  write_text(folder + "/opencv", "\2" + opencv + zero + opencv_extrinsics());
  write_text(folder + "/euroc", "\3" + euroc_sensor(0.05) + zero + euroc_sensor(-0.06));
}

void write_trajectories(const std::string& folder) {
  write_text(folder + "/kitti.txt",
             "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0.1 0 1 0 0 0 0 1 1.2\n"
             "0 0 1 2.5e0 0 1 0 -0.1 -1 0 0 9\n1 0 0 7 0 1 0 0 0 0 1 1.2\n");
  write_text(folder + "/tum.txt",
             "# stamp tx ty tz qx qy qz qw\n1403636579.763555527 0 0 0 0 0 0 1\n"
             "1403636579.813555 0.1 0 0 0 0 0.6 0.8\n1403636579.86 1 2 3 0 0 0 1\n");
  write_text(folder + "/euroc.csv",
             "#timestamp, p_RS_R_x [m]\n"
             "1403636580838555648,4.688,-1.786,0.783,0.534,-0.153,-0.827,-0.082,-0.027,0.033,0.8\n"
             "1403636580843555328,4.688,-1.786,0.783,0.534,-0.153,-0.827,-0.082,-0.027,0.033,0.8\n"
             "1403636580848555520,4.689,-1.786,0.783,0.534,-0.153,-0.827,-0.082,-0.027,0.03,0.8\n");
}

void write_words(const std::string& folder) {
  constexpr std::array kWords = {
      "v4l2:/dev/video0,/dev/video1",
      "libcamera:cam@10,1",
      "synthetic:mine,frames=20,seed=3,width=160,roll_right_deg=-1.5,blur=0",
      "electrons=5@10:20,seed=7",
      "blackout@:200",
      "gain=1.5",
      "occlude=left@5:",
      "width_px=177",
      "descriptor=intensity",
      "exposure_ms=0.5e1",
      "1403636584.66356",
      "-1.5e-3",
      "b/cam@10",
  };
  for (std::size_t i = 0; i < kWords.size(); ++i) {
    write_text(folder + "/" + std::to_string(i), kWords.at(i));
  }
}

void write_jpegs(const std::string& folder) {
  const auto write = [&](const char* name, const std::vector<std::uint8_t>& jpeg) {
    write_text(folder + "/" + name, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
  };
  write("grey.jpg", jpeg_image(32, 16));
  write("colour.jpg", jpeg_image(32, 16, {.quality = 40, .is_colour = true}));
  write("bare.jpg", without_segments(jpeg_image(32, 16, {.is_colour = true}), 0xC4));
  write("progressive.jpg", jpeg_image(32, 16, {.is_progressive = true}));
}

}  // namespace
}  // namespace darkling::test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("write_seeds DIR\n", stderr);
    return 64;
  }
  using namespace darkling::test;  // NOLINT(google-build-using-namespace)
  const std::string folder = argv[1];
  write_text(folder + "/frame_log/empty.lcmlog", "");  // makes the folder
  write_tiny_frame_log(folder + "/frame_log/tiny.lcmlog");
  write_messages(folder + "/messages");
  write_configs(folder + "/config");
  write_calibrations(folder + "/calibration");
  write_trajectories(folder + "/trajectory");
  write_words(folder + "/words");
  write_jpegs(folder + "/jpeg");
  return 0;
}
