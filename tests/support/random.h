// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

#include <Eigen/Core>

namespace darkling::test {

// Random numbers that are the same on every machine: the standard fixes the engine's bits but not
// what its distributions make of them, so the mapping is our own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // In [low, high).
  [[nodiscard]] double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

  // In [low, high].
  [[nodiscard]] int integer(int low, int high) {
    return low + static_cast<int>(engine_() % (static_cast<std::uint64_t>(high - low) + 1));
  }

  // Every component in [-bound, bound).
  template <int N>
  [[nodiscard]] Eigen::Matrix<double, N, 1> vector(double bound) {
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i) v[i] = uniform(-bound, bound);
    return v;
  }

  // Of length 1, every direction as likely: drawn from the cube, kept inside the ball.
  [[nodiscard]] Eigen::Vector3d direction() {
    while (true) {
      const Eigen::Vector3d v = vector<3>(1.0);
      if (v.norm() < 1.0 && v.norm() > 0.1) return v.normalized();
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace darkling::test
