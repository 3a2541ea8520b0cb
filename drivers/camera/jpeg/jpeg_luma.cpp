// SPDX-License-Identifier: Apache-2.0
#include "drivers/camera/jpeg_luma.h"

#include <algorithm>
#include <csetjmp>

#include <jerror.h>

#include "drivers/camera/jpeg/jpeg_memory.h"

namespace darkling {

// libjpeg keeps pointers into it: it stays where it was made.
struct JpegLuma::State {
  explicit State(int most_width_px);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void forget_tables();
  bool read_head(const ImageView<std::uint8_t>& grey);
  bool read_rows(const ImageView<std::uint8_t>& grey);
  bool decode(std::span<const std::uint8_t> jpeg, const ImageView<std::uint8_t>& grey);

  jpeg_decompress_struct image = {};
  jpeg_error_mgr errors = {};
  JpegMemory memory;
  jpeg_memory_mgr* own_memory = nullptr;  // of libjpeg
  std::jmp_buf on_error = {};
  bool is_damaged = false;
};

bool can_decode_jpeg() {
  return true;
}

JpegLuma::State::State(int most_width_px) : memory(most_width_px) {
  image.err = jpeg_std_error(&errors);
  image.client_data = this;
  // C has no exceptions, and on some machines those of C++ do not pass through it.
  errors.error_exit = [](j_common_ptr cinfo) {
    std::longjmp(static_cast<State*>(cinfo->client_data)->on_error, 1);
  };
  errors.emit_message = [](j_common_ptr cinfo, int level) {
    // Warnings are below 0; bytes between segments cost nothing, and many cameras leave some.
    const bool is_harmless = level >= 0 || cinfo->err->msg_code == JWRN_EXTRANEOUS_DATA;
    if (!is_harmless) static_cast<State*>(cinfo->client_data)->is_damaged = true;
  };
  errors.output_message = [](j_common_ptr) {};
  jpeg_create_decompress(&image);
  own_memory = image.mem;
  image.mem = memory.methods();
}

JpegLuma::State::~State() {
  image.mem = own_memory;
  jpeg_destroy_decompress(&image);
}

// libjpeg would decode an image that brings no tables with those of the one before, which may have
// been damaged.
void JpegLuma::State::forget_tables() {
  is_damaged = false;
  std::ranges::fill(image.quant_tbl_ptrs, nullptr);
  std::ranges::fill(image.dc_huff_tbl_ptrs, nullptr);
  std::ranges::fill(image.ac_huff_tbl_ptrs, nullptr);
  image.src = nullptr;
  memory.forget();
}

bool JpegLuma::State::read_head(const ImageView<std::uint8_t>& grey) {
  if (jpeg_read_header(&image, TRUE) != JPEG_HEADER_OK) return false;
  const bool is_of_size = image.image_width == static_cast<JDIMENSION>(grey.width) &&
                          image.image_height == static_cast<JDIMENSION>(grey.height);
  if (!is_of_size || jpeg_has_multiple_scans(&image) != FALSE) return false;
  image.out_color_space = JCS_GRAYSCALE;
  image.dct_method = JDCT_ISLOW;
  image.do_fancy_upsampling = FALSE;
  return true;
}

bool JpegLuma::State::decode(std::span<const std::uint8_t> jpeg,
                             const ImageView<std::uint8_t>& grey) {
  forget_tables();
  jpeg_mem_src(&image, jpeg.data(), jpeg.size());
  const bool is_whole = read_head(grey) && read_rows(grey) && !is_damaged;
  jpeg_abort_decompress(&image);
  return is_whole;
}

bool JpegLuma::State::read_rows(const ImageView<std::uint8_t>& grey) {
  jpeg_start_decompress(&image);
  while (image.output_scanline < image.output_height && !is_damaged) {
    JSAMPROW row = grey.row(static_cast<int>(image.output_scanline));
    jpeg_read_scanlines(&image, &row, 1);
  }
  return !is_damaged && jpeg_finish_decompress(&image) != FALSE;
}

JpegLuma::JpegLuma(int most_width_px) : state_(std::make_unique<State>(most_width_px)) {}
JpegLuma::~JpegLuma() = default;
JpegLuma::JpegLuma(JpegLuma&&) noexcept = default;
JpegLuma& JpegLuma::operator=(JpegLuma&&) noexcept = default;

bool JpegLuma::decode(std::span<const std::uint8_t> jpeg, const ImageView<std::uint8_t>& grey) {
  if (jpeg.empty()) return false;
  // Nothing that has to be destroyed lives between here and where libjpeg finds an error.
  if (setjmp(state_->on_error) != 0) {
    jpeg_abort_decompress(&state_->image);
    return false;
  }
  return state_->decode(jpeg, grey);
}

}  // namespace darkling
