// SPDX-License-Identifier: Apache-2.0
#include "support/guarded_image.h"

#include <sys/mman.h>
#include <unistd.h>

#include "base/check.h"

namespace darkling::test {
namespace {

std::size_t page_bytes() {
  return static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

GuardedMemory::GuardedMemory(std::size_t min_bytes) {
  const std::size_t page = page_bytes();
  const std::size_t usable = (min_bytes + page - 1) / page * page;
  void* block = mmap(nullptr, usable + 2 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  CHECK(block != MAP_FAILED, "the test machine has memory for a small image");
  bytes_ = {static_cast<std::byte*>(block) + page, usable};
  const int fault = mprotect(bytes_.data(), usable, PROT_READ | PROT_WRITE);
  CHECK(fault == 0, "our own pages can be opened");
  for (std::size_t i = 0; i < usable; ++i) bytes_[i] = pattern(i);
}

GuardedMemory::~GuardedMemory() {
  const std::size_t page = page_bytes();
  munmap(bytes_.data() - page, bytes_.size() + 2 * page);
}

std::byte GuardedMemory::pattern(std::size_t index) {
  return static_cast<std::byte>((index * 37 + 11) & 0xff);
}

}  // namespace darkling::test
