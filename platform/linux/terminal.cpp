// SPDX-License-Identifier: Apache-2.0
#include "platform/terminal.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace darkling {

namespace {

// xterm's private modes 1049 (the other screen) and 25 (the cursor); Linux's console knows them.
constexpr std::string_view kEnter = "\033[?1049h\033[?25l\033[2J";
constexpr std::string_view kLeave = "\033[0m\033[?25h\033[?1049l";

bool write_out(std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
         std::fflush(stdout) == 0;
}

}  // namespace

bool is_stderr_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

std::optional<TerminalSize> read_stdout_size() {
  constexpr TerminalSize kUsual = {.columns = 80, .rows = 24};
  if (isatty(STDOUT_FILENO) != 1) return std::nullopt;
  winsize size = {};
  // Serial lines do not know their size and say 0.
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    return kUsual;
  }
  return TerminalSize{.columns = size.ws_col, .rows = size.ws_row};
}

bool is_locale_utf8() {
  // As POSIX has it, the first of these that is set and not empty decides.
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    const std::string locale = value;
    for (const char* suffix : {"UTF-8", "utf8", "utf-8", "UTF8"}) {
      if (locale.find(suffix) != std::string::npos) return true;
    }
    return false;
  }
  return false;
}

struct TerminalScreen::Keyboard {
  termios before = {};
};

TerminalScreen::TerminalScreen() {
  auto keyboard = std::make_unique<Keyboard>();
  if (tcgetattr(STDIN_FILENO, &keyboard->before) == 0) {
    termios silent = keyboard->before;
    silent.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // Ctrl-C still is a signal
    tcsetattr(STDIN_FILENO, TCSANOW, &silent);
    keyboard_ = std::move(keyboard);
  }
  if (is_stderr_terminal()) {
    std::fflush(stderr);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
      stderr_fd_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
      dup2(nowhere, STDERR_FILENO);
      close(nowhere);
    }
  }
  write_out(kEnter);
}

TerminalScreen::~TerminalScreen() {
  write_out(kLeave);
  if (stderr_fd_ >= 0) {
    std::fflush(stderr);
    dup2(stderr_fd_, STDERR_FILENO);
    close(stderr_fd_);
  }
  if (keyboard_ != nullptr) tcsetattr(STDIN_FILENO, TCSANOW, &keyboard_->before);
}

bool TerminalScreen::draw(std::string_view text) {
  return write_out(text);
}

std::optional<char> TerminalScreen::take_key() {
  if (keyboard_ == nullptr) return std::nullopt;
  pollfd input = {.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  char key = 0;
  if (poll(&input, 1, 0) != 1 || read(STDIN_FILENO, &key, 1) != 1) return std::nullopt;
  return key;
}

}  // namespace darkling
