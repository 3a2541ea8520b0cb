# SPDX-License-Identifier: Apache-2.0
# A process that is killed is started again and knows where it is, from a new origin.
configure loopback
start_feed
start_service
check_heard "poses are valid" 40 "VO_POSE status=VALID" --times 5
pid="$(main_pid)"
kill -KILL "$pid"
check "another process takes over within 5 s" wait_until 5 \
  bash -c '[[ "$(systemctl show -P MainPID darklingd)" != 0 && "$(systemctl show -P MainPID darklingd)" != '"$pid"' ]]'
check_heard "poses are valid again" 40 "VO_POSE status=VALID" --times 5
check_equal "it was started again once" 1 "$(property NRestarts)"
