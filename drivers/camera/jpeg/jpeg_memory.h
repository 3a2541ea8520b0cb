// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>  // before jpeglib.h, which asks for it
#include <vector>

#include <jpeglib.h>

namespace darkling {

// Stands in for libjpeg's manager of memory, which asks the heap for every image. What libjpeg
// keeps over images (tables, at most a few kilobytes) and what it needs for one lie in two areas
// that are claimed once; what does not fit is an error of that image. Images that would have to be
// kept whole (several scans) are such an error. Thread: one at a time.
class JpegMemory {
 public:
  // @param most_width_px  of an image.
  explicit JpegMemory(int most_width_px);
  JpegMemory(const JpegMemory&) = delete;  // libjpeg knows where it is
  JpegMemory& operator=(const JpegMemory&) = delete;

  // What a jpeg_decompress_struct's `mem` is to point to, once it is created.
  [[nodiscard]] jpeg_memory_mgr* methods() { return &methods_; }
  // Everything that was handed out is no more.
  void forget();

 private:
  // Memory that is handed out from its beginning on, until all of it is given back.
  struct Area {
    std::vector<std::byte> bytes;
    std::size_t used = 0;
  };
  // libjpeg hands its own structure to every method; ours begins with what it knows.
  struct Methods : jpeg_memory_mgr {
    JpegMemory* memory = nullptr;
  };

  static JpegMemory& of(j_common_ptr cinfo);
  static void* take(j_common_ptr cinfo, int pool, std::size_t size);
  static JSAMPARRAY take_rows(j_common_ptr cinfo, int pool, JDIMENSION width, JDIMENSION height);
  static JBLOCKARRAY take_blocks(j_common_ptr cinfo, int pool, JDIMENSION width, JDIMENSION height);
  static void give_back(j_common_ptr cinfo, int pool);

  Area kept_;
  Area of_image_;
  Methods methods_ = {};
};

}  // namespace darkling
