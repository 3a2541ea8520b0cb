// SPDX-License-Identifier: Apache-2.0
// A program with faults that sanitizers find: where run.sh hears of none, it would hear of no
// other.
#include <thread>

namespace {

int count = 0;

void add_without_a_lock() {
  for (int i = 0; i < 1000; ++i) ++count;
}

}  // namespace

int main() {
  std::thread other(add_without_a_lock);
  add_without_a_lock();
  other.join();
  volatile int* gone = new int(count);
  delete gone;
  return *gone > 0 ? 0 : 1;
}
