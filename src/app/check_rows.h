// SPDX-License-Identifier: Apache-2.0
// What `darkling check` prints: a row for each thing that can be wrong before a start.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace darkling {

enum class Finding { kOk = 0, kNotChecked, kWarning, kWrong };

struct CheckRow {
  std::string name;
  Finding finding = Finding::kOk;
  std::string text;                     // what was found; when it is not well, what to do
  ExitCode code = ExitCode::kInternal;  // with kWrong
};

class CheckRows {
 public:
  void ok(std::string name, std::string text) {
    rows_.push_back({std::move(name), Finding::kOk, std::move(text)});
  }
  void not_checked(std::string name, std::string why) {
    rows_.push_back({std::move(name), Finding::kNotChecked, std::move(why)});
  }
  void warning(std::string name, std::string text) {
    rows_.push_back({std::move(name), Finding::kWarning, std::move(text)});
  }
  void wrong(std::string name, Error error) {
    rows_.push_back({std::move(name), Finding::kWrong, std::move(error.message), error.code});
  }

  [[nodiscard]] const std::vector<CheckRow>& rows() const { return rows_; }
  [[nodiscard]] std::optional<Error> first_wrong() const;

 private:
  std::vector<CheckRow> rows_;
};

// "  name           ok: text", a line a row; further lines of a text are indented.
[[nodiscard]] std::string format_rows(const CheckRows& rows);

}  // namespace darkling
