// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/image_view.h"
#include "drivers/synthetic/scene.h"
#include "drivers/synthetic/shade.h"
#include "drivers/synthetic/visibility.h"
#include "geometry/stereo_rig.h"

namespace darkling::synthetic {

enum class Eye { kLeft = 0, kRight = 1 };

// Renders the frames of one scene. Every pixel is the mean of samples spread over its area and over
// the time the shutter is open; each sample meets the exact surface.
// Thread: const; each thread brings its own Scratch.
class FrameRenderer {
 public:
  struct Scratch {
    std::array<VisibilityBuffer, kMoments> visible;
    std::vector<ProjectedVertex> projected;
    std::vector<float> light;
    std::vector<float> row;
  };

  // @pre check_synthetic() accepted the specification.
  explicit FrameRenderer(const SyntheticSpec& spec);

  [[nodiscard]] const StereoRig& rig() const { return rig_; }
  // The moment in the middle of exposure `frame`, s since the first.
  [[nodiscard]] double time_s(int frame) const { return frame / spec_.rate_hz; }
  [[nodiscard]] Se3 T_scene_body(double t_s) const { return path_.T_scene_body(t_s); }

  void render(int frame, Eye eye, Scratch& scratch, ImageView<std::uint8_t> image) const;

  // Radiance over middle grey at the sensor, before noise: width × height.
  [[nodiscard]] std::span<const float> render_light(int frame, Eye eye, Scratch& scratch) const;

  // The point of the scene that the pixel sees at a moment, found facet by facet: the
  // yardstick that the fast way is tested by.
  [[nodiscard]] std::optional<Vector3> surface_point(double t_s, Eye eye,
                                                     const Eigen::Vector2d& pixel) const;

 private:
  struct Lens {
    PinholeView guide;                  // sees all that the camera sees; pose not set
    std::vector<Eigen::Vector2f> rays;  // of every sample: pattern × row × column
    std::vector<std::int32_t> nearest;  // the guide's pixel nearest to each ray
    std::vector<float> transmission;    // vignetting, per pixel
  };
  [[nodiscard]] Lens make_lens(const Camera& camera) const;
  // @return the distance along the unit `direction` to the first front of a facet, at most
  //         `nearest_m`.
  [[nodiscard]] double nearest_hit(std::span<const Triangle> triangles, const Vector3& origin,
                                   const Vector3& direction, double nearest_m) const;
  [[nodiscard]] int sample_count(int frame) const;
  [[nodiscard]] Shader::Moment make_moment(const Lens& lens, const Se3& T_body_eye, double t_s,
                                           int pattern) const;
  // Adds kMoments samples to every pixel of scratch.light.
  void add_samples(const Lens& lens, const std::array<Shader::Moment, kMoments>& moments,
                   Scratch& scratch) const;

  SyntheticSpec spec_;
  StereoRig rig_;
  RoverPath path_;
  Scene scene_;
  Lens lenses_[2];
};

}  // namespace darkling::synthetic
