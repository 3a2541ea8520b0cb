// SPDX-License-Identifier: Apache-2.0
#include "app/top/top.h"

#include <algorithm>
#include <cstdio>

#include "app/top/lay_out.h"
#include "app/top/listener.h"
#include "app/top/top_json.h"
#include "platform/clocks.h"
#include "platform/signals.h"
#include "platform/terminal.h"

namespace darkling {

namespace {

constexpr Duration kSlice = std::chrono::milliseconds(50);
constexpr Duration kDrawPeriod = std::chrono::milliseconds(500);
constexpr Duration kLinePeriod = std::chrono::seconds(1);
// Statuses come every half second; most of a second more is for a machine that is busy.
constexpr Duration kOnceTimeout = std::chrono::seconds(2);
// Poses come at the camera's rate, but not while there is none.
constexpr Duration kPoseTimeout = std::chrono::milliseconds(300);

tl::unexpected<Error> nothing_heard(const Heard& heard, const View& view) {
  std::string message = explain_silence(heard, view);
  message.erase(message.find_last_not_of('\n') + 1);
  return failure(ExitCode::kDeviceUnavailable, message);
}

Result<int> show_once(Listener& listener, View view, bool is_json) {
  const Heard& heard = listener.heard();
  const auto is_complete = [&] {
    return heard.status &&
           ((heard.pose && heard.update) || view.now - heard.status_at > kPoseTimeout);
  };
  while (!is_stop_requested() && !is_complete() &&
         (heard.status || view.now - view.started_at < kOnceTimeout)) {
    listener.listen(view.now + kSlice);
    view.now = read_monotonic_clock();
  }
  if (!heard.status) return nothing_heard(heard, view);
  view.has_map = false;
  const std::string text = is_json ? format_heard_json(heard) : plain_text(lay_out(heard, view));
  std::fputs(text.c_str(), stdout);
  return 0;
}

// @return false when the terminal is gone or its user has had enough.
bool draw(TerminalScreen& screen, const Heard& heard, const View& view) {
  const auto size = read_stdout_size();
  if (!size) return false;
  View fitting = view;
  fitting.has_map = size->columns >= kPageColumns;
  return screen.draw(painted(lay_out(heard, fitting), size->columns, size->rows));
}

// Until the end, at the user's wish, or when nobody can read it any more.
void watch_screen(Listener& listener, View& view, MonotonicTime end) {
  TerminalScreen screen;
  while (!is_stop_requested() && view.now < end && draw(screen, listener.heard(), view)) {
    const MonotonicTime next_draw = view.now + kDrawPeriod;
    while (view.now < next_draw && !is_stop_requested()) {
      if (screen.take_key() == 'q') return;
      listener.listen(std::min({next_draw, view.now + kSlice, end}));
      view.now = read_monotonic_clock();
      if (view.now >= end) return;
    }
  }
}

void watch_lines(Listener& listener, View& view, MonotonicTime end) {
  while (!is_stop_requested() && view.now < end) {
    listener.listen(std::min(view.now + kLinePeriod, end));
    view.now = read_monotonic_clock();
    std::printf("%s\n", one_line(listener.heard(), view).c_str());
    if (std::fflush(stdout) != 0) return;
  }
}

}  // namespace

Result<int> run_top(const TopOptions& options) {
  catch_stop_signals();
  Listener listener(options.lcm_url, options.channel_prefix);
  const MonotonicTime now = read_monotonic_clock();
  View view = {.url = options.lcm_url,
               .prefix = options.channel_prefix,
               .now = now,
               .started_at = now,
               .glyphs = is_locale_utf8() ? Glyphs::kUnicode : Glyphs::kAscii};
  if (options.is_once) return show_once(listener, view, options.is_json);
  const MonotonicTime end = options.duration ? now + *options.duration : MonotonicTime::max();
  if (read_stdout_size()) {
    watch_screen(listener, view, end);
  } else {
    watch_lines(listener, view, end);
  }
  if (options.duration && !listener.heard().status && !is_stop_requested()) {
    return nothing_heard(listener.heard(), view);
  }
  return 0;
}

}  // namespace darkling
