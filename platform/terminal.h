// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string_view>

namespace darkling {

// Whether a person may be watching standard error: it is a terminal.
[[nodiscard]] bool is_stderr_terminal();

// The same of standard output, by its size; nothing when it is no terminal.
struct TerminalSize {
  int columns = 0;
  int rows = 0;
};
[[nodiscard]] std::optional<TerminalSize> read_stdout_size();

// Whether the user's locale says that text is UTF-8.
[[nodiscard]] bool is_locale_utf8();

// Standard output as a page that is drawn again and again: on the terminal's other screen, without
// a cursor and without the echo of keys. What libraries say on standard error meanwhile would be
// drawn over it, and is dropped where that is a terminal. All of that is undone at the end.
// @pre standard output is a terminal. Thread: one.
class TerminalScreen {
 public:
  TerminalScreen();
  ~TerminalScreen();
  TerminalScreen(const TerminalScreen&) = delete;
  TerminalScreen& operator=(const TerminalScreen&) = delete;

  // @return false when the terminal is gone.
  [[nodiscard]] bool draw(std::string_view text);
  // A key that was pressed since the last call.
  [[nodiscard]] std::optional<char> take_key();

 private:
  int stderr_fd_ = -1;                  // standard error as it was; -1: left alone
  struct Keyboard;                      // how it was before
  std::unique_ptr<Keyboard> keyboard_;  // none when standard input is no terminal
};

}  // namespace darkling
