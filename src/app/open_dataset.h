// SPDX-License-Identifier: Apache-2.0
// The parts of open_source() that know one layout each.
#pragma once

#include <optional>
#include <string>

#include "app/dataset_layout.h"
#include "app/open_source.h"

namespace darkling {

// What `folder` looks like, complete or not: any of image_0, image_1 or calib.txt is KITTI, mav0 is
// EuRoC.
[[nodiscard]] std::optional<DatasetLayout> recognise_layout(const std::string& folder);

[[nodiscard]] Result<Recording> open_kitti(const std::string& folder, const OpenOptions& options);
[[nodiscard]] Result<Recording> open_euroc(const std::string& folder, const OpenOptions& options);
// @param path  a file; a frame log by its first bytes or its name's end.
[[nodiscard]] bool is_frame_log(const std::string& path);
[[nodiscard]] Result<Recording> open_framelog(const std::string& path, const OpenOptions& options);
// @param text  "synthetic:SCENE[,key=value…]".
[[nodiscard]] Result<Recording> open_synthetic(std::string_view text, const OpenOptions& options);

// Why `path` is not opened: absent, empty, a file or a folder of something else; with the folder
// that was perhaps meant.
[[nodiscard]] Error explain_unknown_source(const std::string& path);

}  // namespace darkling
