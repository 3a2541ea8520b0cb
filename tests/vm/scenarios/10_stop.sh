# SPDX-License-Identifier: Apache-2.0
# Asked to end, it ends at once and well, tracking or not.
configure loopback
start_feed
start_service
check_heard "it tracks" 40 "VO_STATUS state=TRACKING"
check_stops_at_once
stop_feed
configure vivid 'camera="v4l2:/dev/video98,/dev/video99"'
start_service
check_heard "it says that there is no camera" 20 "VO_STATUS state=NO_CAMERA"
check_stops_at_once
