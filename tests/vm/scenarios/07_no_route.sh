# SPDX-License-Identifier: Apache-2.0
# Without a multicast route nothing can be published; that is said, and mends itself.
configure loopback
start_feed
systemctl stop darkling-lcm-route
check "there is no route" bash -c '! ip route get 239.255.76.67'
start_service
check "what is wrong is said" wait_until 10 service_says "multicast|route|lcm"
check "the service stays" is_active
pid="$(main_pid)"
check "the unit of the route makes one" systemctl start darkling-lcm-route
check_heard "then poses are published" 30 "VO_POSE status=VALID"
systemctl stop darkling-lcm-route
sleep 2
systemctl start darkling-lcm-route
check_heard "and again after a route that went" 30 "VO_POSE status=VALID"
check_equal "in the same process" "$pid" "$(main_pid)"
