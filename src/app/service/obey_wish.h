// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/service/command_ring.h"
#include "vo/odometry.h"

namespace darkling {

// Asks the odometry for what is wished for before its next frame: one way for the service and for
// the replay of what it recorded. No heap call.
// @param wish  a hint spans the time from the frame before to the next one.
void obey_wish(Odometry& odometry, const Wish& wish);

}  // namespace darkling
