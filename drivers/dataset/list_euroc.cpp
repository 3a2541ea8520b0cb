// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>

#include "base/text_file.h"
#include "drivers/dataset/dataset_rows.h"

namespace darkling {

namespace {

// Eyes triggered together differ by far less; frames of 100 Hz are 10 ms apart.
constexpr std::int64_t kMaxStampGap_ns = 5'000'000;
constexpr int kNoPartner = -1;

struct CsvImage {
  std::int64_t stamp_ns = 0;
  std::string name;
  std::string path;
  int partner = kNoPartner;  // index in the other eye's list
};

// @param line  "stamp,name"; more columns are of no interest.
Result<CsvImage> parse_line(const std::string& folder, const std::string& csv_path,
                            const TextLine& line) {
  const std::vector<std::string_view> fields = split(line.text, ',');
  const auto stamp_ns = parse_number<std::int64_t>(fields[0]);
  if (!stamp_ns || fields.size() < 2 || fields[1].empty()) {
    return failure(ExitCode::kBadInput, at_line(csv_path, line.number) + "found '" + line.text +
                                            "', 'time stamp in ns,file name' is needed");
  }
  const std::string name(fields[1]);
  return CsvImage{.stamp_ns = *stamp_ns, .name = name, .path = folder + "/data/" + name};
}

// @param folder  a camera's: holds data.csv and data/.
Result<std::vector<CsvImage>> read_csv(const std::string& folder) {
  const std::string path = folder + "/data.csv";
  const auto lines = read_text_lines(path);
  if (!lines) return tl::unexpected(lines.error());
  std::vector<CsvImage> images;
  for (const TextLine& line : *lines) {
    // A header without its '#'.
    const bool is_header = images.empty() && std::isalpha(static_cast<unsigned char>(line.text[0]));
    if (is_header && line.number == lines->front().number) continue;
    auto image = parse_line(folder, path, line);
    if (!image) return tl::unexpected(image.error());
    images.push_back(std::move(*image));
  }
  if (images.empty()) return failure(ExitCode::kBadInput, path + ": lists no images");
  return images;
}

void join(std::vector<CsvImage>& left, int l, std::vector<CsvImage>& right, int r) {
  left[l].partner = r;
  right[r].partner = l;
}

// Indices of the images without a partner, by stamp.
std::multimap<std::int64_t, int> index_by_stamp(const std::vector<CsvImage>& images) {
  std::multimap<std::int64_t, int> index;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].partner == kNoPartner) {
      index.emplace(images[i].stamp_ns, static_cast<int>(i));
    }
  }
  return index;
}

// First those within 0 ns, so that no neighbour takes an equal's place, then the nearest within
// `max_gap_ns`.
void match_by_stamp(std::vector<CsvImage>& left, std::vector<CsvImage>& right,
                    std::int64_t max_gap_ns) {
  std::multimap<std::int64_t, int> alone = index_by_stamp(right);
  for (std::size_t l = 0; l < left.size() && !alone.empty(); ++l) {
    if (left[l].partner != kNoPartner) continue;
    const std::int64_t stamp_ns = left[l].stamp_ns;
    auto nearest = alone.lower_bound(stamp_ns);
    const bool may_be_before = nearest != alone.begin();
    if (may_be_before && (nearest == alone.end() ||
                          stamp_ns - std::prev(nearest)->first < nearest->first - stamp_ns)) {
      nearest = std::prev(nearest);
    }
    if (std::abs(nearest->first - stamp_ns) > max_gap_ns) continue;
    join(left, static_cast<int>(l), right, nearest->second);
    alone.erase(nearest);
  }
}

// A stamp that was garbled in one list leaves the file name, which is the same in both.
void match_by_name(std::vector<CsvImage>& left, std::vector<CsvImage>& right) {
  std::map<std::string, int> alone;
  for (std::size_t r = 0; r < right.size(); ++r) {
    if (right[r].partner == kNoPartner) alone.emplace(right[r].name, static_cast<int>(r));
  }
  for (std::size_t l = 0; l < left.size(); ++l) {
    const auto found = alone.find(left[l].name);
    if (left[l].partner != kNoPartner || found == alone.end()) continue;
    join(left, static_cast<int>(l), right, found->second);
    alone.erase(found);
  }
}

// All images of the left in their order, with the right's lonely ones slipped in by stamp.
std::vector<DatasetRow> merge_rows(const std::vector<CsvImage>& left,
                                   const std::vector<CsvImage>& right) {
  std::vector<DatasetRow> rows;
  const std::multimap<std::int64_t, int> alone = index_by_stamp(right);
  auto next_alone = alone.begin();
  const auto push = [&rows](std::int64_t stamp_ns, std::string left_path, std::string right_path) {
    rows.push_back({.sequence = static_cast<std::int64_t>(rows.size()),
                    .stamp = frame_time_from_ns(stamp_ns),
                    .left_path = std::move(left_path),
                    .right_path = std::move(right_path)});
  };
  for (const CsvImage& image : left) {
    for (; next_alone != alone.end() && next_alone->first < image.stamp_ns; ++next_alone) {
      push(next_alone->first, "", right[next_alone->second].path);
    }
    push(image.stamp_ns, image.path,
         image.partner == kNoPartner ? std::string() : right[image.partner].path);
  }
  for (; next_alone != alone.end(); ++next_alone) {
    push(next_alone->first, "", right[next_alone->second].path);
  }
  return rows;
}

}  // namespace

Result<std::vector<DatasetRow>> list_euroc_rows(const std::string& mav0_folder) {
  auto left = read_csv(mav0_folder + "/cam0");
  if (!left) return tl::unexpected(left.error());
  auto right = read_csv(mav0_folder + "/cam1");
  if (!right) return tl::unexpected(right.error());
  match_by_stamp(*left, *right, 0);
  match_by_stamp(*left, *right, kMaxStampGap_ns);
  match_by_name(*left, *right);
  const bool has_pair = std::any_of(left->begin(), left->end(), [](const CsvImage& image) {
    return image.partner != kNoPartner;
  });
  if (!has_pair) {
    return failure(ExitCode::kBadInput,
                   mav0_folder + ": none of the " + std::to_string(left->size()) +
                       " images of cam0 is within 5 ms of one of the " +
                       std::to_string(right->size()) + " of cam1. Are they of one recording?");
  }
  return merge_rows(*left, *right);
}

}  // namespace darkling
