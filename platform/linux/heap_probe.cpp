// SPDX-License-Identifier: Apache-2.0
// Takes the place of glibc's allocator for the whole program, shared libraries included: symbols of
// the executable come first. It must be linked as an object, straight into the executable. The
// linker's --wrap was tried: it misses what libstdc++ and OpenCV allocate inside themselves.
#include "platform/heap_probe.h"

#include <cerrno>
#include <cstddef>

#include <unistd.h>

// glibc's own names of its allocator. NOLINTBEGIN(readability-identifier-naming)
extern "C" {
void* __libc_malloc(std::size_t bytes);
void* __libc_calloc(std::size_t count, std::size_t bytes);
void* __libc_realloc(void* block, std::size_t bytes);
void* __libc_memalign(std::size_t alignment, std::size_t bytes);
void* __libc_valloc(std::size_t bytes);
void* __libc_pvalloc(std::size_t bytes);
void __libc_free(void* block);
}

namespace {

// In the executable's static block: reading it never allocates.
thread_local std::int64_t calls = 0;

}  // namespace

namespace darkling {

std::optional<std::int64_t> count_heap_calls() {
  return calls;
}

}  // namespace darkling

extern "C" {

void* malloc(std::size_t bytes) {
  ++calls;
  return __libc_malloc(bytes);
}

void* calloc(std::size_t count, std::size_t bytes) {
  ++calls;
  return __libc_calloc(count, bytes);
}

void* realloc(void* block, std::size_t bytes) {
  ++calls;
  return __libc_realloc(block, bytes);
}

void* reallocarray(void* block, std::size_t count, std::size_t bytes) {
  ++calls;
  std::size_t product = 0;
  if (__builtin_mul_overflow(count, bytes, &product)) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_realloc(block, product);
}

void* memalign(std::size_t alignment, std::size_t bytes) {
  ++calls;
  return __libc_memalign(alignment, bytes);
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  ++calls;
  return __libc_memalign(alignment, bytes);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) {
  ++calls;
  if (alignment % sizeof(void*) != 0 || alignment == 0 || (alignment & (alignment - 1)) != 0) {
    return EINVAL;
  }
  void* const found = __libc_memalign(alignment, bytes);
  if (found == nullptr) return ENOMEM;
  *block = found;
  return 0;
}

void* valloc(std::size_t bytes) {
  ++calls;
  return __libc_valloc(bytes);
}

void* pvalloc(std::size_t bytes) {
  ++calls;
  return __libc_pvalloc(bytes);
}

void free(void* block) {
  ++calls;
  __libc_free(block);
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming)
