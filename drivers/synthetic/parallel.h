// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <thread>
#include <vector>

namespace darkling::synthetic {

// Runs body(row) for every row of [0, rows) on the machine's cores. Rows must not depend on each
// other, so that the outcome does not depend on how many cores there are.
template <class Body>
void for_each_row(int rows, const Body& body) {
  const int workers = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 8);
  std::vector<std::thread> threads;
  threads.reserve(workers);
  for (int w = 0; w < workers; ++w) {
    threads.emplace_back([w, workers, rows, &body] {
      for (int row = w; row < rows; row += workers) body(row);
    });
  }
  for (std::thread& t : threads) t.join();
}

}  // namespace darkling::synthetic
