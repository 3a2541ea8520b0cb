// SPDX-License-Identifier: Apache-2.0
#include "support/painted_stack.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include <pthread.h>
#include <sys/mman.h>

namespace darkling::test {

namespace {

constexpr std::size_t kStackBytes = std::size_t{1} << 20;
constexpr std::uint64_t kPattern = 0x5aa5c33c0ff0a5a5u;

struct Task {
  const std::function<void()>& work;
  std::uintptr_t first_frame = 0;
};

void* run_task(void* argument) {
  Task& task = *static_cast<Task*>(argument);
  task.first_frame = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  task.work();
  return nullptr;
}

void run_on(std::uint64_t* stack, Task& task) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, stack, kStackBytes);
  pthread_t thread = {};
  const int error = pthread_create(&thread, &attributes, run_task, &task);
  pthread_attr_destroy(&attributes);
  if (error != 0) throw std::runtime_error("no thread could be started");
  pthread_join(thread, nullptr);
}

}  // namespace

std::size_t measure_stack_bytes(const std::function<void()>& work) {
  void* const block = mmap(nullptr, kStackBytes, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
  if (block == MAP_FAILED) throw std::runtime_error("no memory for a stack");
  auto* const stack = static_cast<std::uint64_t*>(block);
  std::uint64_t* const end = stack + kStackBytes / sizeof(std::uint64_t);
  std::fill(stack, end, kPattern);
  Task task{work};
  run_on(stack, task);
  // It grows downwards: the first word that has changed is the deepest one used.
  const std::uint64_t* const deepest =
      std::find_if(stack, end, [](std::uint64_t word) { return word != kPattern; });
  const std::size_t used = task.first_frame - reinterpret_cast<std::uintptr_t>(deepest);
  munmap(block, kStackBytes);
  return used;
}

}  // namespace darkling::test
