# SPDX-License-Identifier: Apache-2.0
# Asked to end, it ends at once and well, tracking or not.
stopped_within() {
  local asked_us ended_us
  systemctl stop darklingd
  asked_us="$(property ActiveExitTimestampMonotonic)"
  ended_us="$(property ExecMainExitTimestampMonotonic)"
  check_below "it ends within a second, us" 1000000 $((ended_us - asked_us))
  check_equal "with success" "success 0" "$(property Result) $(property ExecMainStatus)"
}
configure loopback
start_feed
start_service
check_heard "it tracks" 40 "VO_STATUS state=TRACKING"
stopped_within
stop_feed
configure vivid 'camera="v4l2:/dev/video98,/dev/video99"'
start_service
check_heard "it says that there is no camera" 20 "VO_STATUS state=NO_CAMERA"
stopped_within
