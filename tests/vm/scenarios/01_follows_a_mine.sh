# SPDX-License-Identifier: Apache-2.0
# A rendered drive played into a pair of V4L2 devices comes out as motion. Whether it is the right
# motion is judged on the host, against the truth.
configure loopback
start_feed
start_service
check "its status line says something" test -n "$(property StatusText)"
# A start under emulation takes long and skips frames.
check_heard "frames of the pair are tracked" 40 "VO_STATUS state=TRACKING frames_tracked>10"
check_heard "and go on being tracked" 60 "VO_POSE status=VALID" --times 60 \
  --poses "$scratch/estimate.tum"
check_below "hardly an image lacks its other eye" 5 "$(heard VO_STATUS frames_unpaired)"
check_equal "no frame is bad" 0 "$(heard VO_STATUS frames_bad)"
check_equal "the track was never broken" 0 "$(heard VO_STATUS reset_counter)"
check "motions are published beside poses" grep -q "^VO_UPDATE .*status=VALID" "$scratch/heard"
