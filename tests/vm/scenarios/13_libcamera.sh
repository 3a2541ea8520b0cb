# SPDX-License-Identifier: Apache-2.0
# libcamera on the kernel's virtual camera, both eyes in one image. Each sees another half of a test
# pattern, of which no motion can be measured: that has to be said, and all else is as with any
# camera. The driver stays loaded: libcamera 0.0.3 ends a process under which it goes.

# How many frames the service says it worked on between the first VO_STATUS of $scratch/heard and the
# last, and how many VO_UPDATE came between them.
worked_on_and_published() {
  awk '$1 == "VO_UPDATE" { ++updates }
       $1 == "VO_STATUS" {
         for (i = 2; i <= NF; ++i) { split($i, word, "="); value[word[1]] = word[2] }
         last = value["frames_tracked"] + value["frames_lost"]
         if (!has_first++) { first = last; updates = 0 }
         published = updates
       }
       END { print last - first, published }' "$scratch/heard"
}

configure vimc lock_memory=true realtime_priority=50
start_service
check_heard "without the driver there is no camera" 20 "VO_STATUS state=NO_CAMERA" --times 3
check "that is said" service_says "\"$vimc\": there is none; libcamera sees no camera"
pid="$(main_pid)"

modprobe vimc
check_heard "with it frames arrive" 60 "VO_STATUS state!=NO_CAMERA frames_in>10"
check_heard "and go on arriving, and are worked on" 60 \
  "VO_STATUS state!=NO_CAMERA rate_in_hz>1 rate_out_hz>1" --times 10
echo "     at $(heard VO_STATUS rate_in_hz) Hz, worked on at $(heard VO_STATUS rate_out_hz) Hz"
read -r worked_on published < <(worked_on_and_published)
check_at_least "frames are worked on between two reports" 5 "$worked_on"
check_equal "an update is published for each of them" "$worked_on" "$published"
check "their numbers grow" does_grow VO_UPDATE seq
check "their stamps grow" does_grow VO_UPDATE mono_ns
check_at_least "which are in the past, ms" 1 "$(whole "$(heard VO_STATUS latency_p50_ms)")"
check_below "and not by long, ms" 2000 "$(whole "$(heard VO_STATUS latency_max_ms)")"
check_equal "they are the sensor's" 3 "$(heard VO_STATUS stamp_source)"
check_equal "exposure, gain and how good stamps are it does not say, so they are not known" "-1 -1 0" \
  "$(heard VO_STATUS exposure_ms) $(heard VO_STATUS gain) $(heard VO_STATUS stamp_uncertainty_ms)"
check_equal "no image is bad or lacks its other eye" "0 0" \
  "$(heard VO_STATUS frames_bad) $(heard VO_STATUS frames_unpaired)"
check_equal "no motion is claimed to be measured" LOST "$(heard VO_STATUS state)"
check_equal "nor by any update" "status=LOST quality=-1" \
  "$(grep "^VO_UPDATE " "$scratch/heard" | grep -o "status=[A-Z]* quality=[-0-9]*" | sort -u)"
check "each says why" bash -c '! grep "^VO_UPDATE .* reasons=0 " "$scratch/heard"'
check_memory
check_equal "it is all one process" "$pid 0" "$(main_pid) $(property NRestarts)"

(cd /run && exec timeout 60 runuser -u darkling -- /usr/bin/darklingd --config "$config" \
  --set channel_prefix=SECOND_) >"$scratch/second" 2>&1 &
second_pid=$!
check "another program is told that the camera may be taken" \
  wait_until 40 grep -q "another program has" "$scratch/second"
check_heard "the first does not notice" 20 "VO_STATUS state!=NO_CAMERA rate_in_hz>1" --times 3
kill "$second_pid"
wait "$second_pid"

configure vimc 'camera="libcamera:Sensor Z"'
check "a camera that there is not can be configured" systemctl reload darklingd
check_heard "it is missed" 20 "VO_STATUS state=NO_CAMERA" --times 3
check "with its name and those there are" \
  service_says '"Sensor Z": there is none; libcamera sees 0 "platform/vimc.0 Sensor B"'
check "also in the status line" bash -c '[[ "$(systemctl show -P StatusText darklingd)" == *"Sensor Z"* ]]'
configure vimc
check "the right one can be configured again" systemctl reload darklingd
check_heard "then frames arrive" 40 "VO_STATUS state!=NO_CAMERA frames_in>10"
check_equal "still in the same process" "$pid 0" "$(main_pid) $(property NRestarts)"

check_stops_at_once
start_service
check_heard "started anew frames arrive" 40 "VO_STATUS state!=NO_CAMERA frames_in>10"
check_equal "it is not restarted" 0 "$(property NRestarts)"
