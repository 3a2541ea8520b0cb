// SPDX-License-Identifier: Apache-2.0
#include "drivers/camera/jpeg/jpeg_memory.h"

#include <cstdint>
#include <cstdlib>

#include <jerror.h>

namespace darkling {

namespace {

// Of rows and blocks: as libjpeg's own, whose vector code reads and writes beyond a row's end up to
// there.
constexpr std::size_t kAlignment = 64;
constexpr std::size_t kKeptBytes = 32 * 1024;
// Derived tables and states of one image, less than 16 KiB; and rows: of at most 4 components, each
// up to 4 rows of 8 lines, in two buffers.
constexpr std::size_t kImageBytes = 64 * 1024;
constexpr std::size_t kRowsOfWidth = 4 * 4 * 8 * 2;

constexpr std::size_t rounded_up(std::size_t size) {
  return (size + kAlignment - 1) / kAlignment * kAlignment;
}

[[noreturn]] void refuse(j_common_ptr cinfo, int code) {
  cinfo->err->msg_code = code;
  (*cinfo->err->error_exit)(cinfo);
  std::abort();  // it does not return
}

jvirt_sarray_ptr refuse_rows(j_common_ptr cinfo, int, boolean, JDIMENSION, JDIMENSION, JDIMENSION) {
  refuse(cinfo, JERR_NOT_COMPILED);
}

jvirt_barray_ptr refuse_blocks(j_common_ptr cinfo, int, boolean, JDIMENSION, JDIMENSION,
                               JDIMENSION) {
  refuse(cinfo, JERR_NOT_COMPILED);
}

}  // namespace

JpegMemory::JpegMemory(int most_width_px) {
  kept_.bytes.resize(kKeptBytes + kAlignment);
  of_image_.bytes.resize(kImageBytes + kAlignment +
                         kRowsOfWidth *
                             (rounded_up(static_cast<std::size_t>(most_width_px)) + kAlignment));
  methods_.memory = this;
  methods_.alloc_small = take;
  methods_.alloc_large = take;
  methods_.alloc_sarray = take_rows;
  methods_.alloc_barray = take_blocks;
  methods_.request_virt_sarray = refuse_rows;
  methods_.request_virt_barray = refuse_blocks;
  methods_.realize_virt_arrays = [](j_common_ptr) {};
  methods_.free_pool = give_back;
  methods_.self_destruct = [](j_common_ptr) {};
  methods_.max_memory_to_use = static_cast<long>(of_image_.bytes.size());
  methods_.max_alloc_chunk = static_cast<long>(of_image_.bytes.size());
}

void JpegMemory::forget() {
  kept_.used = 0;
  of_image_.used = 0;
}

JpegMemory& JpegMemory::of(j_common_ptr cinfo) {
  return *static_cast<Methods*>(cinfo->mem)->memory;
}

void* JpegMemory::take(j_common_ptr cinfo, int pool, std::size_t size) {
  Area& area = pool == JPOOL_PERMANENT ? of(cinfo).kept_ : of(cinfo).of_image_;
  const auto address = reinterpret_cast<std::uintptr_t>(area.bytes.data()) + area.used;
  const std::size_t gap = rounded_up(address) - address;
  const std::size_t left = area.bytes.size() - area.used;
  if (size > left || gap > left - size) refuse(cinfo, JERR_OUT_OF_MEMORY);
  std::byte* taken = area.bytes.data() + area.used + gap;
  area.used += gap + size;
  return taken;
}

JSAMPARRAY JpegMemory::take_rows(j_common_ptr cinfo, int pool, JDIMENSION width,
                                 JDIMENSION height) {
  auto* rows = static_cast<JSAMPARRAY>(take(cinfo, pool, height * sizeof(JSAMPROW)));
  for (JDIMENSION y = 0; y < height; ++y) {
    rows[y] = static_cast<JSAMPROW>(take(cinfo, pool, rounded_up(width * sizeof(JSAMPLE))));
  }
  return rows;
}

JBLOCKARRAY JpegMemory::take_blocks(j_common_ptr cinfo, int pool, JDIMENSION width,
                                    JDIMENSION height) {
  auto* rows = static_cast<JBLOCKARRAY>(take(cinfo, pool, height * sizeof(JBLOCKROW)));
  for (JDIMENSION y = 0; y < height; ++y) {
    rows[y] = static_cast<JBLOCKROW>(take(cinfo, pool, width * sizeof(JBLOCK)));
  }
  return rows;
}

void JpegMemory::give_back(j_common_ptr cinfo, int pool) {
  if (pool == JPOOL_IMAGE) of(cinfo).of_image_.used = 0;
}

}  // namespace darkling
