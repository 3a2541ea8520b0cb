// SPDX-License-Identifier: Apache-2.0
#include "support/kernel_cases.h"

#include <ostream>
#include <random>

#include "platform/cpu_features.h"

namespace darkling {

void PrintTo(const KernelTable& table, std::ostream* stream) {
  *stream << table.name;
}

}  // namespace darkling

namespace darkling::test {
namespace {

void fill_between(ImageView<std::uint8_t> image, int low, int high, unsigned seed) {
  std::mt19937 random(seed);
  const auto levels = static_cast<unsigned>(high - low + 1);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      image.at(x, y) = static_cast<std::uint8_t>(low + static_cast<int>(random() % levels));
    }
  }
}

}  // namespace

const char* name_of(Fill fill) {
  switch (fill) {
    case Fill::kUniform:
      return "uniform";
    case Fill::kNearMin:
      return "near min";
    case Fill::kNearMax:
      return "near max";
    case Fill::kConstant:
      return "constant";
    case Fill::kSpike:
      return "spike";
  }
  return "unknown";
}

void fill_image(ImageView<std::uint8_t> image, Fill fill, unsigned seed) {
  switch (fill) {
    case Fill::kUniform:
      return fill_between(image, 0, 255, seed);
    case Fill::kNearMin:
      return fill_between(image, 0, 2, seed);
    case Fill::kNearMax:
      return fill_between(image, 253, 255, seed);
    case Fill::kConstant: {
      const int level = static_cast<int>(seed % 256);
      return fill_between(image, level, level, seed);
    }
    case Fill::kSpike: {
      fill_between(image, 127, 127, seed);
      std::mt19937 random(seed);
      const int x = static_cast<int>(random() % static_cast<unsigned>(image.width));
      const int y = static_cast<int>(random() % static_cast<unsigned>(image.height));
      image.at(x, y) = (random() & 1U) != 0 ? 255 : 0;
      return;
    }
  }
}

void for_each_shape(int max_width, const std::function<void(const GuardedLayout&)>& check) {
  for (int width = 1; width <= max_width; ++width) {
    for (int height = 1; height <= 5; ++height) {
      for (const int distance : {0, 1, 7}) {
        const int row_padding = width % 2 == 0 ? 1 + distance : 2 + distance;
        for (const GuardSide guard : {GuardSide::kBehindLastRow, GuardSide::kBeforeFirstRow}) {
          check({width, height, row_padding, distance, guard});
        }
      }
      check({.width = width, .height = height});  // rows without a gap
    }
  }
}

std::vector<KernelTable> available_tables() {
  std::vector<KernelTable> tables;
  for (const char* name : {"ref", "sse41", "avx2", "neon"}) {
    const Result<KernelTable> table = select_kernels(name, detect_cpu_features());
    if (table) tables.push_back(*table);
  }
  return tables;
}

std::string table_name(const ::testing::TestParamInfo<KernelTable>& info) {
  return info.param.name;
}

}  // namespace darkling::test
