// SPDX-License-Identifier: Apache-2.0
#include "drivers/v4l2/v4l2_spec.h"

namespace darkling {

namespace {

constexpr std::string_view kPrefix = "v4l2:";

tl::unexpected<Error> refuse(std::string_view text, const std::string& reason) {
  return failure(ExitCode::kUsage,
                 "\"" + std::string(text) + "\": " + reason +
                     "; allowed: v4l2:/dev/videoN with both eyes in one image, or "
                     "v4l2:/dev/videoN,/dev/videoM with left and right");
}

}  // namespace

Result<std::vector<std::string>> parse_v4l2(std::string_view text) {
  if (!text.starts_with(kPrefix)) return refuse(text, "is no V4L2 source");
  std::string_view rest = text.substr(kPrefix.size());
  std::vector<std::string> paths;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view path = rest.substr(0, comma);
    if (path.empty()) return refuse(text, "a device is missing");
    if (path.front() != '/') {
      return refuse(text, "\"" + std::string(path) + "\" is no absolute path");
    }
    paths.emplace_back(path);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (paths.size() > 2) {
    return refuse(text, std::to_string(paths.size()) + " devices are named, a rig has two eyes");
  }
  if (paths.size() == 2 && paths[0] == paths[1]) {
    return refuse(text, "both eyes are the same device");
  }
  return paths;
}

}  // namespace darkling
