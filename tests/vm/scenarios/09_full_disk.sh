# SPDX-License-Identifier: Apache-2.0
# A disk that is full ends the recording and nothing else.
mkdir -p /var/lib/darkling/small
mount -t tmpfs -o size=2m small /var/lib/darkling/small
chown darkling: /var/lib/darkling /var/lib/darkling/small
configure loopback record_to=/var/lib/darkling/small record=true
start_feed
start_service
check_heard "frames are recorded" 30 "VO_STATUS is_recording=1 recorded_frames>5"
check_heard "the recording ends when the disk is full" 40 "VO_STATUS is_recording=0 recorded_frames>5"
check "that is said" wait_until 5 service_says "recording"
check_heard "tracking goes on" 20 "VO_STATUS state=TRACKING" --times 3
check_equal "in the same process" 0 "$(property NRestarts)"
check "what was recorded is a file" bash -c 'ls /var/lib/darkling/small/* >/dev/null'
systemctl stop darklingd
umount /var/lib/darkling/small
