// SPDX-License-Identifier: Apache-2.0
// What a recorded data set plays: one row a stereo pair, listed at start-up.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"

namespace darkling {

struct DatasetRow {
  std::int64_t sequence = 0;  // position in the recording, whatever part of it is played
  FrameTime stamp;            // of the left image; of the right where there is no left
  std::string left_path;      // empty: this eye has no image
  std::string right_path;
};

// Which rows to play: [first, last) of the recording's, every `stride`-th of those.
struct RowSelection {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();  // beyond the end: to the end
  std::int64_t stride = 1;                                       // >= 1
};

// A KITTI odometry folder: image_0 and image_1 with the same names, one line of times.txt (seconds)
// a pair. Names that are numbers count the lines of times.txt where there are fewer images than
// lines: numbers absent in both eyes become rows whose files cannot be read.
// @return kNoInput when a folder, times.txt or every image is absent; kBadInput when the eyes hold
//         different images or times.txt does not fit.
[[nodiscard]] Result<std::vector<DatasetRow>> list_kitti_rows(const std::string& folder);

// An EuRoC folder `mav0`: cam0/data.csv and cam1/data.csv, matched by equal stamps, else by the
// nearest within 5 ms, else by equal file names. Rows without a partner are kept, in their place.
// @return kNoInput when a data.csv is absent; kBadInput when one is malformed (with file and line),
//         empty, or nothing matches.
[[nodiscard]] Result<std::vector<DatasetRow>> list_euroc_rows(const std::string& mav0_folder);

[[nodiscard]] std::vector<DatasetRow> select_rows(const std::vector<DatasetRow>& rows,
                                                  const RowSelection& selection);

}  // namespace darkling
