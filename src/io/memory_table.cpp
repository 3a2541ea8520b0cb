// SPDX-License-Identifier: Apache-2.0
#include "io/memory_table.h"

#include <iomanip>
#include <sstream>

#include "vo/limits.h"

namespace darkling {

namespace {

constexpr double kMiB = 1024.0 * 1024.0;
constexpr int kBytesColumn = 10;
constexpr int kNameColumn = 24;
constexpr int kStagesColumn = 18;

void add_row(std::ostream& table, std::string_view bytes, std::string_view count,
             const BufferRow& row) {
  table << "  " << std::right << std::setw(kBytesColumn) << bytes << "  " << std::setw(2) << count
        << "  " << std::left << std::setw(kNameColumn) << row.name << std::setw(kStagesColumn)
        << row.writers << std::setw(kStagesColumn) << row.readers << row.holds << '\n';
}

void add_sum(std::ostream& table, std::size_t bytes, const std::string& what) {
  table << "  " << std::right << std::setw(kBytesColumn) << bytes << "      " << what << '\n';
}

std::string mib_text(std::size_t bytes) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << static_cast<double>(bytes) / kMiB << " MiB";
  return text.str();
}

}  // namespace

std::string format_memory_table(const MemoryMap& map, int width_px, int height_px) {
  std::ostringstream table;
  add_row(table, "bytes", "x",
          {.name = "buffer", .writers = "written by", .readers = "read by", .holds = "holds"});
  for (std::size_t i = 0; i < kBufferRows.size(); ++i) {
    add_row(table, std::to_string(map.bytes[i]), std::to_string(map.counts[i]), kBufferRows[i]);
  }
  add_sum(table, map.gap_bytes, "gaps up to cache lines");
  add_sum(table, map.state_bytes, "the rest of the odometry, beside the arena");
  const std::size_t budget = memory_budget_bytes(width_px, height_px);
  const bool is_within = map.total_bytes() <= budget;
  add_sum(table, map.total_bytes(),
          "total: " + mib_text(map.total_bytes()) + " of a budget of " + mib_text(budget) +
              (is_within ? "" : ", which is EXCEEDED"));
  add_sum(table, kMaxStackBytes, "of stack at most, while a frame is tracked");
  return table.str();
}

}  // namespace darkling
