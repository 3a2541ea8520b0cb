# SPDX-License-Identifier: Apache-2.0
# Two services want one camera: the second says so, the first does not notice.
configure vivid
start_service
check_heard "frames arrive" 40 "VO_STATUS state!=NO_CAMERA frames_in>5"
pid="$(main_pid)"
(cd /run && timeout 15 runuser -u darkling -- /usr/bin/darklingd --config "$config" \
  --set channel_prefix=SECOND_) >"$scratch/second" 2>&1
check "the second says that the camera is taken" grep -Eiq "busy|in use|taken" "$scratch/second"
check_heard "the first still gets frames" 20 \
  "VO_STATUS state!=NO_CAMERA frames_in>$(($(heard VO_STATUS frames_in) + 20))"
check_equal "in the same process" "$pid" "$(main_pid)"
