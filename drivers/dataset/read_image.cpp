// SPDX-License-Identifier: Apache-2.0
#include "drivers/dataset/read_image.h"

#include <cstdio>
#include <vector>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

namespace darkling {

namespace {

// Fills `bytes` with the file, keeping its memory when it suffices.
bool read_file(const std::string& path, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) return false;
  constexpr std::size_t kStep = std::size_t{1} << 18;
  for (;;) {
    const std::size_t have = bytes.size();
    bytes.resize(have + kStep);
    const std::size_t got = std::fread(bytes.data() + have, 1, kStep, file.get());
    bytes.resize(have + got);
    if (got < kStep) return std::ferror(file.get()) == 0;
  }
}

}  // namespace

struct ImageBuffer::State {
  std::vector<std::uint8_t> file;
  cv::Mat pixels;
};

ImageBuffer::ImageBuffer() : state_(std::make_unique<State>()) {
  // Files that cannot be decoded are counted by who reads them, not written to the terminal.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}
ImageBuffer::~ImageBuffer() = default;
ImageBuffer::ImageBuffer(ImageBuffer&&) noexcept = default;
ImageBuffer& ImageBuffer::operator=(ImageBuffer&&) noexcept = default;

bool ImageBuffer::read(const std::string& path) {
  cv::Mat& pixels = state_->pixels;
  if (!read_file(path, state_->file) || !is_complete_image_file(state_->file)) return false;
  try {
    const cv::Mat file(1, static_cast<int>(state_->file.size()), CV_8UC1, state_->file.data());
    const int flags = cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION;
    const bool is_decoded = !cv::imdecode(file, flags, &pixels).empty();
    return is_decoded && pixels.type() == CV_8UC1;
  } catch (const cv::Exception&) {
    return false;
  }
}

ImageView<const std::uint8_t> ImageBuffer::image() const {
  const cv::Mat& pixels = state_->pixels;
  return {pixels.data, pixels.cols, pixels.rows, static_cast<std::ptrdiff_t>(pixels.step[0])};
}

Result<ImageSize> first_pair_size(const std::vector<DatasetRow>& rows) {
  ImageBuffer left;
  ImageBuffer right;
  for (const DatasetRow& row : rows) {
    if (!left.read(row.left_path) || !right.read(row.right_path)) continue;
    const ImageSize left_size{left.image().width, left.image().height};
    const ImageSize right_size{right.image().width, right.image().height};
    if (left_size == right_size) return left_size;
    return failure(ExitCode::kBadInput, "left and right images differ in size: " + row.left_path +
                                            " is " + to_text(left_size) + " px, " + row.right_path +
                                            " is " + to_text(right_size) + " px");
  }
  std::string message = "none of " + std::to_string(rows.size()) + " pairs of images can be read";
  if (!rows.empty()) message += ", the first is " + rows.front().left_path;
  return failure(ExitCode::kNoInput, message);
}

std::string to_text(const ImageSize& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace darkling
