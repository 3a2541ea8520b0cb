# SPDX-License-Identifier: Apache-2.0
# A process that stands still is ended by the watchdog and started again.
configure loopback
start_feed
start_service
check_heard "poses are valid" 40 "VO_POSE status=VALID" --times 5
pid="$(main_pid)"
kill -STOP "$pid"
check "another process takes over within 10 s" wait_until 10 \
  bash -c '[[ "$(systemctl show -P MainPID darklingd)" != 0 && "$(systemctl show -P MainPID darklingd)" != '"$pid"' ]]'
check "systemd says that it was the watchdog" service_says "watchdog timeout"
check_heard "poses are valid again" 40 "VO_POSE status=VALID" --times 5
check_equal "it was started again once" 1 "$(property NRestarts)"
