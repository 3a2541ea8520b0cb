# SPDX-License-Identifier: Apache-2.0
# The unit's limits hold and leave what the service may ask for: locked memory and real time.
configure loopback lock_memory=true realtime_priority=50
start_feed
start_service
check_heard "it tracks" 60 "VO_STATUS state=TRACKING frames_tracked>20"
pid="$(main_pid)"
check_memory
check "memory is locked" bash -c '[[ "$(awk "/^VmLck/ { print \$2 }" /proc/'"$pid"'/status)" -gt 0 ]]'
check "a thread runs in real time" bash -c 'ps -L -o cls= -p '"$pid"' | grep -q FF'
check_equal "it has no capability" 0000000000000000 "$(awk '/^CapPrm/ { print $2 }' "/proc/$pid/status")"
check_equal "it runs as its own user" darkling "$(stat -c %U "/proc/$pid")"
