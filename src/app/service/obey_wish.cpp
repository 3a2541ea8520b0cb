// SPDX-License-Identifier: Apache-2.0
#include "app/service/obey_wish.h"

namespace darkling {

void obey_wish(Odometry& odometry, const Wish& wish) {
  switch (wish.kind) {
    case Wish::Kind::kNone:
      return;
    case Wish::Kind::kReset:
      return odometry.reset();
    case Wish::Kind::kReseed:
      return odometry.reseed();
    case Wish::Kind::kHint:
      return odometry.hint(wish.T_previous_body);
  }
}

}  // namespace darkling
