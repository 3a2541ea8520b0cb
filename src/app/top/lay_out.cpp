// SPDX-License-Identifier: Apache-2.0
#include "app/top/lay_out.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "app/service/health.h"
#include "app/top/sections.h"

namespace darkling {

namespace {

constexpr int kMapColumns = kPageColumns - kSectionColumns - 3;
constexpr int kBarColumns = 20;
constexpr int kUptimeColumn = 51;

double seconds(Duration time) {
  return std::chrono::duration<double>(time).count();
}

bool is_silent(const Heard& heard, MonotonicTime now) {
  return !heard.status || now - heard.status_at > kSilence;
}

Tone tone_of(ServiceState state) {
  switch (state) {
    case ServiceState::kTracking:
      return Tone::kGood;
    case ServiceState::kInit:
    case ServiceState::kDegraded:
      return Tone::kWarning;
    case ServiceState::kLost:
    case ServiceState::kNoCamera:
    case ServiceState::kFault:
      return Tone::kBad;
    case ServiceState::kUnknown:
      break;
  }
  return Tone::kPlain;
}

int quality_of(const Heard& heard) {
  if (heard.update) return heard.update->quality;
  return heard.pose ? heard.pose->quality : 0;
}

std::string quality_text(int quality) {
  if (quality < 0) return "failed";
  return quality == 0 ? "not known" : std::to_string(quality);
}

Row quality_bar(int quality, Glyphs glyphs) {
  constexpr int kGood = 50;
  constexpr int kPoor = 20;
  const Tone tone = quality >= kGood ? Tone::kGood : quality >= kPoor ? Tone::kWarning : Tone::kBad;
  const int filled = std::clamp(quality * kBarColumns / 100, quality > 0 ? 1 : 0, kBarColumns);
  const bool is_unicode = glyphs == Glyphs::kUnicode;
  std::string full;
  std::string empty;
  for (int i = 0; i < kBarColumns; ++i) {
    (i < filled ? full : empty) += is_unicode ? (i < filled ? "█" : "░") : (i < filled ? "#" : "-");
  }
  return {{full, tone}, {empty, Tone::kFaint}, {" " + quality_text(quality)}};
}

Row title_row(const Heard& heard, const View& view) {
  std::string where = "darkling top  " + printable(view.url);
  if (!view.prefix.empty()) where += "  prefix " + printable(view.prefix);
  const std::string age =
      heard.status ? fmt::format("status {:.1f} s ago", seconds(view.now - heard.status_at)) : "";
  const int room = kPageColumns - columns_of(age) - 1;
  Row row = pad(clip({{where, Tone::kFaint}}, room), room + 1);
  row.push_back({age, is_silent(heard, view.now) ? Tone::kBad : Tone::kFaint});
  return row;
}

// The state, large; then how good, for how long.
Row state_row(const Heard& heard, const View& view) {
  const status_t& status = *heard.status;
  const ServiceState state = state_from_message(status.state);
  const bool is_old = is_silent(heard, view.now);
  Row row = {{fmt::format(" {} ", is_old ? "SILENT" : name_of(state)),
              is_old ? Tone::kBad : tone_of(state), /*is_inverted=*/true}};
  row = pad(row, kLabelColumns);
  if (is_old) {
    row.push_back(
        {fmt::format(" was {}, quality {}", name_of(state), quality_text(quality_of(heard)))});
  } else {
    row.push_back({" quality "});
    for (Span& span : quality_bar(quality_of(heard), view.glyphs)) row.push_back(std::move(span));
  }
  row = pad(row, kUptimeColumn);
  row.push_back({"up " + time_text(status.uptime_s) + "  "});
  row.push_back({fmt::format("resets {}", status.reset_counter),
                 status.reset_counter > 0 ? Tone::kWarning : Tone::kPlain});
  return row;
}

Row reason_row(const status_t& status) {
  std::string names;
  for (const std::string& name : names_of_reasons(static_cast<std::uint32_t>(status.reasons))) {
    names += (names.empty() ? "" : ", ") + name;
  }
  return labelled("reasons", {names.empty() ? Span{"none"} : Span{names, Tone::kWarning}});
}

// What a person should know before they read on; else which key ends it.
Row notice_row(const Heard& heard, const View& view) {
  if (is_silent(heard, view.now)) {
    return {{fmt::format("No status for {:.0f} s; what is below was so then. Is darklingd running?",
                         seconds(view.now - heard.status_at)),
             Tone::kBad}};
  }
  if (heard.malformed > 0) {
    return {{fmt::format("{} malformed messages: is another version or program on these channels?",
                         heard.malformed),
             Tone::kWarning}};
  }
  return {{view.has_map ? "q ends" : "", Tone::kFaint}};
}

void append(Page& page, const Page& section) {
  page.insert(page.end(), section.begin(), section.end());
}

// Beside the sections, from the top of them down to the last.
void put_map(Page& page, std::size_t first_row, const Heard& heard, const View& view) {
  const std::vector<std::string> map =
      draw_map(heard.track, kMapColumns, static_cast<int>(page.size() - first_row), view.glyphs);
  const char* border = view.glyphs == Glyphs::kUnicode ? " │ " : " | ";
  for (std::size_t i = 0; i < map.size(); ++i) {
    Row& row = page[first_row + i];
    row = pad(clip(row, kSectionColumns), kSectionColumns);
    row.push_back({border, Tone::kFaint});
    row.push_back({map[i]});
  }
}

Page lay_out_silence(const Heard& heard, const View& view) {
  Page page = {title_row(heard, view), {{" NOT HEARD ", Tone::kBad, /*is_inverted=*/true}}, {}};
  std::string text = explain_silence(heard, view);
  for (std::size_t end = text.find('\n'); !text.empty(); end = text.find('\n')) {
    page.push_back({{text.substr(0, end)}});
    text = end == std::string::npos ? "" : text.substr(end + 1);
  }
  return page;
}

}  // namespace

Page lay_out(const Heard& heard, const View& view) {
  if (!heard.status) return lay_out_silence(heard, view);
  const bool is_pose_fresh = heard.pose && view.now - heard.pose_at < kSilence;
  Page page = {title_row(heard, view), state_row(heard, view), reason_row(*heard.status),
               notice_row(heard, view)};
  const std::size_t first_row = page.size();
  append(page, pose_section(heard, is_pose_fresh));
  page.emplace_back();
  append(page, frame_section(*heard.status));
  append(page, camera_section(*heard.status));
  append(page, service_section(*heard.status));
  if (!view.has_map) return page;
  put_map(page, first_row, heard, view);
  for (Row& row : page) row = clip(row, kPageColumns);
  return page;
}

std::string explain_silence(const Heard& heard, const View& view) {
  const std::string seconds_text = fmt::format("{:.0f} s", seconds(view.now - view.started_at));
  const std::string url = printable(view.url);
  if (!heard.no_network.empty()) {
    return printable(heard.no_network) +
           ".\n"
           "Is there a multicast route? A network's default route will do; without a network\n"
           "  systemctl enable --now darkling-lcm-route, or by hand\n"
           "  ip link set lo multicast on; ip route add 239.255.76.67/32 dev lo\n"
           "Is the URL of the form udpm://GROUP:PORT?ttl=N?\n";
  }
  std::string text = "No service heard on " + url + " for " + seconds_text + ".\n";
  if (!heard.other_channel.empty()) {
    const std::string other = printable(heard.other_channel);
    return text + "But there is one on channel " + other + ":\n  try --channel-prefix '" +
           other.substr(0, other.rfind("VO_STATUS")) + "'\n";
  }
  return text +
         "Is darklingd running?\n"
         "    systemctl status darklingd; journalctl -u darklingd\n"
         "Are its lcm_url and channel_prefix the same as here?\n"
         "    darklingd --config FILE --print-config\n"
         "Is it on another machine? Then both need ttl=1 in their lcm_url.\n"
         "Is there a multicast route, and no firewall between?\n"
         "    ip route get 239.255.76.67\n";
}

std::string one_line(const Heard& heard, const View& view) {
  if (is_silent(heard, view.now)) {
    const MonotonicTime since = heard.status ? heard.status_at : view.started_at;
    return fmt::format("SILENT {:.0f} s", seconds(view.now - since));
  }
  const status_t& status = *heard.status;
  std::string line = fmt::format("{} quality {} in {} Hz out {} Hz latency {} ms reasons {}",
                                 name_of(state_from_message(status.state)), quality_of(heard),
                                 figure(status.rate_in_hz, 1), figure(status.rate_out_hz, 1),
                                 figure(status.latency_p50_ms, 1),
                                 describe_reasons(static_cast<std::uint32_t>(status.reasons)));
  if (heard.pose) {
    const double* const t = heard.pose->translation;
    line += fmt::format(" x {} y {} z {} m driven {} m", figure(t[0], 2), figure(t[1], 2),
                        figure(t[2], 2), figure(heard.track.distance_m(), 1));
  }
  return line;
}

}  // namespace darkling
