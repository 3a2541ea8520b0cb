// SPDX-License-Identifier: Apache-2.0
#include "app/check_rows.h"

#include <algorithm>
#include <cstddef>

namespace darkling {

namespace {

constexpr std::size_t kNameWidth = 14;

const char* word_of(Finding finding) {
  switch (finding) {
    case Finding::kOk:
      return "ok: ";
    case Finding::kNotChecked:
      return "not checked: ";
    case Finding::kWarning:
      return "warning: ";
    case Finding::kWrong:
      return "wrong: ";
  }
  return "";
}

}  // namespace

std::optional<Error> CheckRows::first_wrong() const {
  const auto wrong = std::find_if(rows_.begin(), rows_.end(), [](const CheckRow& row) {
    return row.finding == Finding::kWrong;
  });
  if (wrong == rows_.end()) return std::nullopt;
  return Error{.code = wrong->code, .message = wrong->text};
}

std::string format_rows(const CheckRows& rows) {
  std::string text;
  for (const CheckRow& row : rows.rows()) {
    text += "  " + row.name;
    text.append(row.name.size() < kNameWidth ? kNameWidth - row.name.size() : 0, ' ');
    text += std::string(" ") + word_of(row.finding);
    for (const char c : row.text) {
      text += c;
      if (c == '\n') text.append(kNameWidth + 3, ' ');
    }
    text += '\n';
  }
  return text;
}

}  // namespace darkling
