# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154
# What scenarios are written with; sourced by guest.sh. A scenario prints one line a check, beginning
# with `ok`, `FAIL` or `skip`, and goes on after a failure.

readonly config=/etc/darkling/darkling.yaml
readonly loopback_left=/dev/video20 loopback_right=/dev/video21
readonly vivid_left=/dev/video10 vivid_right=/dev/video11
readonly vimc="Sensor B"
readonly rate_hz=5

ok() { echo "ok   $scenario: $1"; }
skip() { echo "skip $scenario: $1"; }
# fail CLAIM [WHAT_WAS_FOUND]: the first failure of a scenario shows what the service said.
fail() {
  echo "FAIL $scenario: $1${2:+ -- found: $2}"
  if [[ -z "${has_shown_journal:-}" ]]; then
    service_log | tail -n 15 | sed 's/^/     | /'
    has_shown_journal=yes
  fi
}

# check CLAIM COMMAND…: ok when the command succeeds, else FAIL with what it printed.
check() {
  local claim="$1" printed
  shift
  if printed="$("$@" 2>&1)"; then ok "$claim"; else fail "$claim" "$(tail -n 3 <<<"$printed")"; fi
}

# check_equal CLAIM WANTED FOUND
check_equal() {
  if [[ "$3" == "$2" ]]; then ok "$1"; else fail "$1" "\`$3\`, wanted: \`$2\`"; fi
}

# check_below CLAIM LIMIT FOUND: integers.
check_below() {
  if [[ -n "$3" && "$3" -lt "$2" ]]; then ok "$1 ($3)"; else fail "$1" "$3, limit: $2"; fi
}

# check_at_least CLAIM LEAST FOUND: integers.
check_at_least() {
  if [[ -n "$3" && "$3" -ge "$2" ]]; then ok "$1 ($3)"; else fail "$1" "$3, least: $2"; fi
}

# wait_until SECONDS COMMAND…: whether the command succeeded within that time.
wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < end)) || return 1
    sleep 0.2
  done
}

# The settings in which the cameras differ.
settings_of() {
  case "$1" in
    vivid)
      echo "camera: \"v4l2:$vivid_left,$vivid_right\""
      echo "calibration: /etc/darkling/wide/mav0"
      ;;
    vimc)
      echo "camera: \"libcamera:$vimc\""
      echo "calibration: /etc/darkling/square/mav0"
      echo "layout: side_by_side"
      echo "pixel_format: any"
      echo "width_px: 96"
      ;;
    *)
      echo "camera: \"v4l2:$loopback_left,$loopback_right\""
      echo "calibration: /etc/darkling/mine/mav0"
      ;;
  esac
}

# configure SOURCE [KEY=VALUE…]: writes the service's configuration for `loopback`, `vivid` or `vimc`.
configure() {
  local source="$1" setting
  shift
  {
    # Nothing keeps the test driver's two in step, and emulation delays what arrives.
    echo "max_skew_ms: 100"
    echo "width_px: 160"
    echo "pixel_format: grey"
    echo "rate_hz: $rate_hz"
    echo "points_per_level: 300"
    settings_of "$source"
    for setting in "$@"; do echo "${setting%%=*}: ${setting#*=}"; done
  } | awk -F: '{ last[$1] = $0; if (!seen[$1]++) order[++n] = $1 }
               END { for (i = 1; i <= n; ++i) print last[order[i]] }' >"$config"
}

property() { systemctl show -P "$1" darklingd; }
main_pid() { property MainPID; }
is_active() { systemctl is-active --quiet darklingd; }

# The journal of the service since the scenario began.
service_log() { journalctl -u darklingd --since "@$scenario_start" -o cat --no-pager; }
service_says() { service_log | grep -Eiq -- "$1"; }

# Starts what `configure` wrote; Type=notify: it returns when the service says it is ready. Without a
# service the scenario is over.
start_service() {
  systemctl reset-failed darklingd 2>/dev/null
  check "the service starts and says that it is ready" systemctl restart darklingd
  is_active || exit 1
}

# Ends the service, which is to take a second at most.
check_stops_at_once() {
  local asked_us ended_us
  systemctl stop darklingd
  asked_us="$(property ActiveExitTimestampMonotonic)"
  ended_us="$(property ExecMainExitTimestampMonotonic)"
  check_below "it ends within a second, us" 1000000 $((ended_us - asked_us))
  check_equal "with success" "success 0" "$(property Result) $(property ExecMainStatus)"
}

# The unit's limit of memory holds, and is far.
check_memory() {
  local group limit
  group="/sys/fs/cgroup$(property ControlGroup)"
  limit="$(<"$group/memory.max")"
  check_equal "the limit of memory is the unit's" 201326592 "$limit"
  check_below "resident memory, kB, is below it" $((limit / 1024)) \
    "$(awk '/^VmRSS/ { print $2 }' "/proc/$(main_pid)/status")"
  check_below "so was all of its memory at its height, bytes" "$limit" "$(<"$group/memory.peak")"
  check_equal "nothing was ended for want of memory" 0 \
    "$(awk '/^oom_kill / { print $2 }' "$group/memory.events")"
}

start_feed() {
  [[ -n "${feed_pid:-}" ]] && return
  feed_loopback "$loopback_left" "$loopback_right" "$(<"$assets/mine.size")" "$rate_hz" \
    "$assets/mine.raw" "$scratch/feed.log" &
  feed_pid=$!
  wait_until 10 test -s "$scratch/feed.log" || fail "frames are fed to the loopback devices"
}

stop_feed() {
  [[ -z "${feed_pid:-}" ]] && return
  kill "$feed_pid" 2>/dev/null
  wait "$feed_pid" 2>/dev/null
  feed_pid=
}

# check_heard CLAIM SECONDS "CHANNEL CONDITION…" [OPTION…]: whether that is published; see hear.cpp.
# What was heard is kept in $scratch/heard.
check_heard() {
  local claim="$1" seconds="$2" wanted="$3"
  shift 3
  if hear --for "$seconds" --until "$wanted" "$@" >"$scratch/heard" 2>&1; then
    ok "$claim"
  else
    fail "$claim" "$(wc -l <"$scratch/heard") messages, at last: $(tail -n 1 "$scratch/heard")"
  fi
}

# heard CHANNEL KEY: that field of the last such message in $scratch/heard.
heard() {
  grep "^$1 " "$scratch/heard" | tail -n 1 | tr ' ' '\n' | sed -n "s/^$2=//p"
}

# whole NUMBER: without what follows the point.
whole() { echo "${1%%.*}"; }

# does_grow CHANNEL KEY: whether in $scratch/heard that field is greater in every such message than in
# the one before, and there are two at least.
does_grow() {
  grep "^$1 " "$scratch/heard" | tr ' ' '\n' | sed -n "s/^$2=//p" \
    | awk 'NR > 1 && $1 + 0 <= last + 0 { print $1 " after " last; has_not_grown = 1 }
           { last = $1 }
           END { exit has_not_grown || NR < 2 }'
}
