// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "geometry/frames.h"
#include "geometry/se3.h"

namespace darkling {
namespace {

TEST(VehicleAxes, AreForwardLeftAndUp) {
  const Matrix3 R = R_vehicle_optical();
  EXPECT_EQ(R * Vector3::UnitZ(), Vector3::UnitX());   // the camera looks forward
  EXPECT_EQ(R * Vector3::UnitX(), -Vector3::UnitY());  // its right is not the left
  EXPECT_EQ(R * Vector3::UnitY(), -Vector3::UnitZ());  // its down is not up
  EXPECT_EQ(R.determinant(), 1.0);
}

TEST(ReducePixel, MapsEdgesToEdges) {
  EXPECT_EQ(reduce_pixel(-0.5, 4.0), -0.5);
  EXPECT_EQ(reduce_pixel(639.5, 4.0), 159.5);
}

TEST(ReducePixel, MapsTheMeanOfABoxToItsPixel) {
  EXPECT_EQ(reduce_pixel(0.5, 2.0), 0.0);            // pixels 0 and 1
  EXPECT_EQ(reduce_pixel(6.0 + 1.0, 3.0), 2.0);      // pixels 6, 7, 8
  EXPECT_NE(reduce_pixel(100.0, 2.0), 100.0 / 2.0);  // halving alone is off by a quarter
}

TEST(ReducePixel, InTwoStepsIsOneStep) {
  EXPECT_DOUBLE_EQ(reduce_pixel(reduce_pixel(123.4, 2.0), 2.0), reduce_pixel(123.4, 4.0));
}

}  // namespace
}  // namespace darkling
