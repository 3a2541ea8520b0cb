# SPDX-License-Identifier: Apache-2.0
# A reload takes a good configuration over and leaves things as they are with a bad one.
configure loopback
start_feed
start_service
check_heard "it tracks at the source's width" 40 "VO_STATUS state=TRACKING width=160"
pid="$(main_pid)"

configure loopback width_px=96
check "a good configuration is reloaded" systemctl reload darklingd
check_heard "it tracks at the new width" 40 "VO_STATUS state=TRACKING width=96"

configure loopback width_px=7
systemctl reload darklingd
check "a bad configuration is named with its key" wait_until 10 service_says "width_px"
check_heard "the old one stays" 40 "VO_STATUS state=TRACKING width=96" --times 3
check_equal "in the same process" "$pid" "$(main_pid)"
