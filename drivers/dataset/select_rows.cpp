// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/check.h"
#include "drivers/dataset/dataset_rows.h"

namespace darkling {

std::vector<DatasetRow> select_rows(const std::vector<DatasetRow>& rows,
                                    const RowSelection& selection) {
  CHECK(selection.first >= 0 && selection.stride >= 1, "a selection runs forward");
  std::vector<DatasetRow> selected;
  const auto end = std::min(static_cast<std::int64_t>(rows.size()), selection.last);
  for (std::int64_t i = selection.first; i < end;) {
    selected.push_back(rows[static_cast<std::size_t>(i)]);
    if (selection.stride >= end - i) break;  // the sum below cannot overflow
    i += selection.stride;
  }
  return selected;
}

}  // namespace darkling
