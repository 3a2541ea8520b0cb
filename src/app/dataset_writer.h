// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/dataset_layout.h"
#include "base/result.h"
#include "base/stereo_frame.h"
#include "geometry/stereo_rig.h"

namespace darkling {

// Writes stereo frames and their true poses as a dataset: images first, then the rows that name
// them. Poses that are not known are left out, and the file of poses where it would be of no use.
class DatasetWriter {
 public:
  virtual ~DatasetWriter() = default;
  // @param T_world_body  the true pose; nothing: not known.
  // @return kUsage when something cannot be written.
  virtual Result<void> add(const StereoFrame& frame, const std::optional<Se3>& T_world_body) = 0;
  // A pair that is missing, in its place: a row without images.
  virtual Result<void> skip(FrameTime stamp, const std::optional<Se3>& T_world_body) = 0;
  virtual Result<void> close() = 0;
};

struct DatasetDescription {
  std::string folder;
  std::string about;  // what it is of, for comments
  StereoRig rig;
  double rate_hz = 0.0;  // 0: not known
};

// Creates the folders, the calibration and empty indices.
// @return kUsage when something cannot be written.
[[nodiscard]] Result<std::unique_ptr<DatasetWriter>> create_euroc_writer(
    const DatasetDescription& description);
// @pre the rig is rectified: no distortion, both cameras turned alike.
[[nodiscard]] Result<std::unique_ptr<DatasetWriter>> create_kitti_writer(
    const DatasetDescription& description);

// Removes a file that turned out to be of no use. @return kUsage with path and reason.
[[nodiscard]] Result<void> remove_file(const std::string& path);

// Makes sure that `folder` can take a new dataset. @param is_forced  removes an earlier dataset,
// and only that, from it.
// @return kUsage when it is not empty, not a folder or cannot be made.
[[nodiscard]] Result<void> prepare_folder(const std::string& folder, bool is_forced);

// What both writers are made of. @return kUsage with path and reason.
[[nodiscard]] Result<void> make_folder(const std::string& path);
[[nodiscard]] Result<void> write_png(const std::string& path,
                                     const ImageView<const std::uint8_t>& image);

}  // namespace darkling
