// SPDX-License-Identifier: Apache-2.0
#include "vo/covariance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

namespace darkling {

namespace {

// Tiles an image is cut into. Half or a quarter as many were no better.
constexpr int kTiles = 80;
constexpr int kMaxTiles = 2 * kTiles;  // with those that the border cuts, up to 1280x24 px

// How much of a point's Gram matrix is noise of the planes, a share of the sum of squares of its
// residuals. White noise smoothed as the planes are would make it 0.12; points are chosen for being
// salient, so those are preferred whose noise adds to it. Measured at 160 px and 300
// photo-electrons: with 0, 0.12, 0.17 variances of motions in the mine came out 2.4, 1.7, 1.4 times
// too small, in the corridor 11, 5.3, 3.4 times; at 4000 photo-electrons it makes them greater by a
// fifth at most. With 0.2, as in tests/accuracy, they were 1.10 times too small over all scenes and
// lights.
constexpr float kNoiseOfGram = 0.2f;

// Where so much is taken from H that nothing certain is left, B is this share of H: what it is
// elsewhere, when variances are promised by H alone and come out 2 to 3 times too small.
constexpr double kShareOfInformation = 0.6;

// From keyframe to keyframe errors are not quite independent, as the next sees the same surfaces:
// NEES at the ends of runs was 1.8 where that of their motions was 1.1.
constexpr double kKeyframeFactor = 1.6;

// Of all disparities. Scale came out off by 0.1 to 0.4 % in rendered scenes at 320 px, by up to 1 %
// at 160 px and by 0.6 to 1.4 % in recordings, where calibration has its part: some hundredths of a
// pixel all.
constexpr double kDisparityBiasPx = 0.03;

// Steps of an alignment below this end it.
constexpr double kConvergedPx = 0.01;

// Sets c, keeps the one before, and sets what (2) takes from H.
void weigh_residuals(const AlignedFrame& frame, PointInfluences& out) {
  std::swap(out.cx, out.cx_before);
  std::swap(out.cy, out.cy_before);
  const float a = frame.alignment.inverse_scale;
  const PointResiduals& residuals = frame.residuals;
  const int count = frame.finest.points.count;
  for (int i = 0; i < count; ++i) {
    const float fall = 1.0f / (1.0f + residuals.squares[i] * a);
    const float u = residuals.squares[i] < 0.0f ? 0.0f : fall;
    const float bx = residuals.bx[i];
    const float by = residuals.by[i];
    const float w = u * u;
    out.cx[i] = w * bx;
    out.cy[i] = w * by;
    const float k = 4.0f * a * u * w;
    const float noise = kNoiseOfGram * w * residuals.squares[i];
    out.xx[i] = noise + k * bx * bx;
    out.xy[i] = k * bx * by;
    out.yy[i] = noise + k * by * by;
  }
}

// (2). The kernel weighs by 1 where `squares` is not negative, and by 0 behind the last point; what
// it makes of the residuals is not looked at.
Matrix6 bread(const KernelTable& kernels, const AlignedFrame& frame, const PointInfluences& from) {
  TemplatePoints points = frame.finest.points;
  for (int i = points.count; i < round_up_to_lanes(points.count); ++i) {
    from.xx[i] = -1.0f;
    from.xy[i] = 0.0f;
    from.yy[i] = 0.0f;
  }
  points.Sxx = from.xx;
  points.Sxy = from.xy;
  points.Syy = from.yy;
  NormalSums sums;
  kernels.normal_equations(points, {frame.residuals.bx, frame.residuals.by, from.xx},
                           static_cast<float>(frame.rig.focal_px), 0.0f, sums);
  return frame.alignment.information - unpack(sums, frame.rig.focal_px).H;
}

// The tiles, about square, and which of them a point is in.
class Tiling {
 public:
  explicit Tiling(const RectifiedRig& rig) {
    const double side_px = std::sqrt(double(rig.width) * rig.height / kTiles);
    tiles_per_px_ = static_cast<float>(1.0 / side_px);
    columns_ = static_cast<int>(rig.width / side_px) + 1;
    first_ = {static_cast<float>(rig.cx / side_px), static_cast<float>(rig.cy / side_px)};
  }
  // @param x, y  px from the principal point.
  [[nodiscard]] int index(float x, float y) const {
    const int column = static_cast<int>(x * tiles_per_px_ + first_.first);
    const int row = static_cast<int>(y * tiles_per_px_ + first_.second);
    return std::clamp(row * columns_ + column, 0, kMaxTiles - 1);
  }

 private:
  float tiles_per_px_;
  int columns_;
  std::pair<float, float> first_;  // the principal point, in tiles
};

// Adds Jᵀ c / f to the sums of a tile; X = x / f, Y = y / f, and s is the inverse depth.
void add_influence(float X, float Y, float s, float cx, float cy, float (&sums)[6]) {
  const float radial = X * cx + Y * cy;
  sums[0] += s * cx;
  sums[1] += s * cy;
  sums[2] -= s * radial;
  sums[3] -= cy + Y * radial;
  sums[4] += cx + X * radial;
  sums[5] += X * cy - Y * cx;
}

void sum_tiles(const AlignedFrame& frame, const PointInfluences& influences) {
  const TemplatePoints& points = frame.finest.points;
  const Tiling tiling(frame.rig);
  const float inverse_focal = static_cast<float>(1.0 / frame.rig.focal_px);
  std::fill(influences.tiles.begin(), influences.tiles.end(), PointInfluences::Tile());
  for (int i = 0; i < points.count; ++i) {
    const float X = points.x[i] * inverse_focal;
    const float Y = points.y[i] * inverse_focal;
    const float s = points.inverse_depth_focal[i] * inverse_focal;
    const float cx = influences.cx[i];
    const float cy = influences.cy[i];
    PointInfluences::Tile& tile = influences.tiles[tiling.index(points.x[i], points.y[i])];
    add_influence(X, Y, s, cx, cy, tile.alignment);
    add_influence(X, Y, s, cx - influences.cx_before[i], cy - influences.cy_before[i], tile.change);
  }
}

// M of (1), from one of the two sums of each tile.
Matrix6 meat(std::span<const PointInfluences::Tile> tiles, double focal_px,
             const float (PointInfluences::Tile::*member)[6]) {
  Matrix6 M = Matrix6::Zero();
  int count = 0;
  for (const PointInfluences::Tile& tile : tiles) {
    const float(&sums)[6] = tile.*member;
    if (sums[0] == 0.0f && sums[4] == 0.0f) continue;
    ++count;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) M(i, j) += static_cast<double>(sums[i] * sums[j]);
    }
  }
  M = M.selfadjointView<Eigen::Lower>();
  return M * (focal_px * focal_px * count / std::max(count - 6, 1));
}

// What stopping at steps of a hundredth of a pixel leaves, and all there is where nothing moves.
Matrix6 convergence(const AlignedFrame& frame) {
  const double px_per_m =
      std::max(1e-6, static_cast<double>(frame.finest.mean_inverse_depth_focal));
  const double m = kConvergedPx / px_per_m;
  const double rad = kConvergedPx / frame.rig.focal_px;
  Vector6 variances;
  variances << Vector3::Constant(m * m), Vector3::Constant(rad * rad);
  return variances.asDiagonal();
}

// σ of (4): a bias of all disparities, over their mean.
double scale_sigma(const AlignedFrame& frame) {
  const double disparity_px =
      static_cast<double>(frame.finest.mean_inverse_depth_focal) * frame.rig.baseline_m;
  return kDisparityBiasPx / std::max(disparity_px, kDisparityBiasPx);
}

Matrix6 transport(const Matrix6& covariance, const Matrix6& adjoint) {
  return adjoint * covariance * adjoint.transpose();
}

// The displacement of a motion, seen from its end, is less the translation of its inverse.
PoseCovariance::Accumulated accumulate(const PoseCovariance::Accumulated& key,
                                       const AlignedFrame& frame, const Matrix6& of_alignment) {
  const Se3& T_current_key = frame.alignment.T_current_key;
  return {.covariance =
              transport(key.covariance + kKeyframeFactor * of_alignment, T_current_key.adjoint()),
          .scale_m =
              T_current_key.R() * key.scale_m - scale_sigma(frame) * T_current_key.translation()};
}

Matrix6 add_scale(Matrix6 covariance, const Vector3& scale_m) {
  covariance.topLeftCorner<3, 3>() += scale_m * scale_m.transpose();
  return is_known(covariance) ? covariance : unknown_covariance();
}

}  // namespace

bool is_known(const Matrix6& covariance) {
  return covariance.allFinite() && covariance.diagonal().maxCoeff() < kUnknownVariance;
}

Matrix6 transport_covariance(const Matrix6& covariance, const Se3& T_b_a) {
  return is_known(covariance) ? transport(covariance, T_b_a.adjoint()) : covariance;
}

PointInfluences allocate_influences(int points_per_level, Arena& arena) {
  const auto array = [&] {
    return arena.allocate<float>(round_up_to_lanes(points_per_level), "point influences").data();
  };
  return {array(), array(),
          array(), array(),
          array(), array(),
          array(), arena.allocate<PointInfluences::Tile>(kMaxTiles, "influence tiles")};
}

AlignmentCovariances estimate_covariances(const KernelTable& kernels, const AlignedFrame& frame,
                                          bool is_first, PointInfluences& influences) {
  weigh_residuals(frame, influences);
  if (is_first) {
    std::fill_n(influences.cx_before, frame.finest.points.count, 0.0f);
    std::fill_n(influences.cy_before, frame.finest.points.count, 0.0f);
  }
  Eigen::LLT<Matrix6> B(bread(kernels, frame, influences));
  if (B.info() != Eigen::Success) B.compute(kShareOfInformation * frame.alignment.information);
  if (B.info() != Eigen::Success) return {unknown_covariance(), unknown_covariance()};
  sum_tiles(frame, influences);
  const Matrix6 inverse_B = B.solve(Matrix6::Identity());
  const Matrix6 least = convergence(frame);
  const auto sandwich = [&](const float(PointInfluences::Tile::*member)[6]) {
    const Matrix6 M = meat(influences.tiles, frame.rig.focal_px, member);
    return Matrix6(inverse_B * M * inverse_B + least);
  };
  return {.of_alignment = sandwich(&PointInfluences::Tile::alignment),
          .of_change = sandwich(&PointInfluences::Tile::change)};
}

void PoseCovariance::reset() {
  *this = PoseCovariance();
}

void PoseCovariance::set_keyframe() {
  key_ = current_;
  T_current_key_ = Se3();
  is_on_keyframe_ = true;
}

void PoseCovariance::rebase(const Accumulated& key, const KernelTable& kernels,
                            const AlignedFrame& frame, PointInfluences& influences) {
  const bool is_first = true;
  current_ = accumulate(key, frame,
                        estimate_covariances(kernels, frame, is_first, influences).of_alignment);
  key_ = current_;  // to within the motion since, should the frame not become the keyframe
  cov_pose_ = add_scale(current_.covariance, current_.scale_m);
  is_on_keyframe_ = true;  // no influences of the frame before are left
}

void PoseCovariance::move(const KernelTable& kernels, const AlignedFrame& frame,
                          PointInfluences& influences) {
  const AlignmentCovariances aligned =
      estimate_covariances(kernels, frame, is_on_keyframe_, influences);
  const Se3& T_current_key = frame.alignment.T_current_key;
  const Se3 T_current_previous = T_current_key * T_current_key_.inverse();
  const Matrix6 adjoint = T_current_key.adjoint();
  const double sigma = scale_sigma(frame);

  current_ = accumulate(key_, frame, aligned.of_alignment);
  cov_motion_ =
      add_scale(transport(aligned.of_change, adjoint), sigma * T_current_previous.translation());
  cov_pose_ = add_scale(current_.covariance, current_.scale_m);
  T_current_key_ = T_current_key;
  is_on_keyframe_ = false;
}

}  // namespace darkling
