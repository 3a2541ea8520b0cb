# SPDX-License-Identifier: Apache-2.0
# The unit's limits hold and leave what the service may ask for: locked memory and real time.
configure loopback lock_memory=true realtime_priority=50
start_feed
start_service
check_heard "it tracks" 60 "VO_STATUS state=TRACKING frames_tracked>20"
pid="$(main_pid)"
group="/sys/fs/cgroup$(property ControlGroup)"
limit="$(<"$group/memory.max")"
check_equal "the limit is the unit's" 201326592 "$limit"
check_below "resident memory, kB, is below it" $((limit / 1024)) \
  "$(awk '/^VmRSS/ { print $2 }' "/proc/$pid/status")"
check_below "so was all of its memory at its height, bytes" "$limit" "$(<"$group/memory.peak")"
check_equal "nothing was ended for want of memory" 0 "$(awk '/^oom_kill / { print $2 }' "$group/memory.events")"
check "memory is locked" bash -c '[[ "$(awk "/^VmLck/ { print \$2 }" /proc/'"$pid"'/status)" -gt 0 ]]'
check "a thread runs in real time" bash -c 'ps -L -o cls= -p '"$pid"' | grep -q FF'
check_equal "it has no capability" 0000000000000000 "$(awk '/^CapPrm/ { print $2 }' "/proc/$pid/status")"
check_equal "it runs as its own user" darkling "$(stat -c %U "/proc/$pid")"
