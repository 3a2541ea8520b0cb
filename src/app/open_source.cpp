// SPDX-License-Identifier: Apache-2.0
#include "app/open_source.h"

#include "app/open_dataset.h"
#include "base/text_file.h"

namespace darkling {

Result<OpenOptions> parse_frame_range(std::string_view text, OpenOptions options) {
  const auto wrong = [text] {
    return failure(ExitCode::kUsage, "frame range '" + std::string(text) +
                                         "': allowed is A:B, the frames from A up to but without "
                                         "B, counted from 0, as 0:100, 50: or :200");
  };
  const std::vector<std::string_view> ends = split(text, ':');
  if (ends.size() != 2) return wrong();
  const auto first = ends[0].empty() ? options.first : parse_number<std::int64_t>(ends[0]);
  const auto last = ends[1].empty() ? options.last : parse_number<std::int64_t>(ends[1]);
  if (!first || !last || *first < 0 || *last <= *first) return wrong();
  options.first = *first;
  options.last = *last;
  return options;
}

Result<Recording> open_source(std::string_view text, const OpenOptions& options) {
  if (options.first < 0 || options.last <= options.first || options.stride < 1) {
    return failure(ExitCode::kUsage,
                   "frames " + std::to_string(options.first) + ":" + std::to_string(options.last) +
                       " with stride " + std::to_string(options.stride) +
                       ": allowed are 0 <= first < last and a stride of at least 1");
  }
  if (text.starts_with("synthetic:")) return open_synthetic(text, options);
  std::string folder(text);
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  if (is_frame_log(folder)) return open_framelog(folder, options);
  const auto layout = recognise_layout(folder);
  if (!layout) return tl::unexpected(explain_unknown_source(folder));
  return *layout == DatasetLayout::kKitti ? open_kitti(folder, options)
                                          : open_euroc(folder, options);
}

}  // namespace darkling
