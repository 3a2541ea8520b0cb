# SPDX-License-Identifier: Apache-2.0
# A camera that is pulled out is a state that is published, and is taken up again when it returns.
driver=/sys/bus/platform/drivers/vivid

# Whether both nodes come to belong to the group of cameras within 10 s; asked so often that the time of
# its end can be taken for that of their return.
wait_for_nodes() {
  local end=$((SECONDS + 10))
  until [[ "$(stat -c %G "$vivid_left" "$vivid_right" 2>/dev/null)" == $'video\nvideo' ]]; do
    ((SECONDS < end)) || return 1
    sleep 0.02
  done
}

configure vivid
start_service
check_heard "frames arrive" 40 "VO_STATUS state!=NO_CAMERA frames_in>5"
pid="$(main_pid)"

echo vivid.0 >"$driver/unbind"
check "the camera's node is gone" wait_until 5 test ! -e "$vivid_left"
check_heard "a missing camera is published" 10 "VO_STATUS state=NO_CAMERA"
check_heard "and goes on being published, twice a second" 4 "VO_STATUS state=NO_CAMERA" --times 5
frames_before="$(heard VO_STATUS frames_in)"

# Back it is from when the service's user may open both nodes. The driver's upright bars do not tell
# how the camera moved, which is said: that motion is measured again is looked at below.
hear --for 30 --until "VO_UPDATE" >"$scratch/judged" 2>&1 &
hearing=$!
sleep 1
echo vivid.0 >"$driver/bind"
check "the camera's nodes are back" wait_for_nodes
back_us="${EPOCHREALTIME/./}"
if wait "$hearing"; then took_us=$((${EPOCHREALTIME/./} - back_us)); fi
check_below "a frame is judged again within 2 s, us" 2000000 "${took_us:-}"
udevadm settle
check_heard "frames arrive again" 30 \
  "VO_STATUS state!=NO_CAMERA frames_in>$((${frames_before:-0} + 5))"
check_equal "in the same process" "$pid" "$(main_pid)"

# The driver's own way to be pulled out: the node comes back as soon as the last user lets go.
v4l2-ctl -d "$vivid_left" --set-ctrl=disconnect=1 >/dev/null 2>&1
frames_before="$(heard VO_STATUS frames_in)"
check_heard "frames arrive after a short disconnection" 30 \
  "VO_STATUS state!=NO_CAMERA frames_in>$((${frames_before:-0} + 15))"
check_equal "still in the same process" "$pid" "$(main_pid)"

# A source that ends while its nodes stay, with a scene in which motion can be measured.
configure loopback
start_feed
start_service
check_heard "motion is measured" 40 "VO_UPDATE status=VALID" --times 5
pid="$(main_pid)"
stop_feed
check_heard "a source that ended is published as missing" 20 "VO_STATUS state=NO_CAMERA"
hear --for 30 --until "VO_UPDATE status=VALID" >"$scratch/measured" 2>&1 &
hearing=$!
start_feed
if wait "$hearing"; then
  # Uptime and the stamps of what was fed are of the same clock.
  took_ms="$(awk 'NR == FNR { now_ms = 1e3 * $1; next } { print int(now_ms - $1 / 1e6); exit }' \
    /proc/uptime "$scratch/feed.log")"
fi
check_below "motion is measured again within 2 s of the first frame, ms" 2000 "${took_ms:-}"
check_equal "once more in the same process" "$pid" "$(main_pid)"
