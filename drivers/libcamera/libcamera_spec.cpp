// SPDX-License-Identifier: Apache-2.0
#include "drivers/libcamera/libcamera_spec.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace darkling {

namespace {

constexpr std::string_view kPrefix = "libcamera:";

tl::unexpected<Error> refuse(std::string_view text, const std::string& reason) {
  return failure(ExitCode::kUsage,
                 "\"" + std::string(text) + "\": " + reason +
                     "; allowed: libcamera:ID with both eyes in one image, or libcamera:ID,ID with "
                     "left and right");
}

std::string list_text(const std::vector<std::string>& ids) {
  if (ids.empty()) {
    return "libcamera sees no camera (it may not see one that another program has)";
  }
  std::string text = "libcamera sees";
  for (std::size_t i = 0; i < ids.size(); ++i) {
    text += (i == 0 ? " " : ", ") + std::to_string(i) + " \"" + ids[i] + "\"";
  }
  return text;
}

std::optional<std::size_t> as_index(const std::string& name) {
  std::size_t index = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, index);
  if (error != std::errc() || stop != end) return std::nullopt;
  return index;
}

}  // namespace

Result<std::vector<std::string>> parse_libcamera(std::string_view text) {
  if (!text.starts_with(kPrefix)) return refuse(text, "is no libcamera source");
  std::string_view rest = text.substr(kPrefix.size());
  std::vector<std::string> names;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view name = rest.substr(0, comma);
    if (name.empty()) return refuse(text, "a camera is missing");
    names.emplace_back(name);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (names.size() > 2) {
    return refuse(text, std::to_string(names.size()) + " cameras are named, a rig has two eyes");
  }
  if (names.size() == 2 && names[0] == names[1]) {
    return refuse(text, "both eyes are the same camera");
  }
  return names;
}

Result<std::string> find_camera(const std::string& name, const std::vector<std::string>& ids) {
  if (std::find(ids.begin(), ids.end(), name) != ids.end()) return name;
  if (const auto index = as_index(name); index && *index < ids.size()) return ids[*index];
  const auto ends_so = [&](const std::string& id) { return id.ends_with(name); };
  const auto matches = std::count_if(ids.begin(), ids.end(), ends_so);
  if (matches == 1) return *std::find_if(ids.begin(), ids.end(), ends_so);
  return failure(ExitCode::kDeviceUnavailable,
                 "libcamera camera \"" + name + "\": " +
                     (matches == 0 ? "there is none" : "several end so") + "; " + list_text(ids));
}

}  // namespace darkling
