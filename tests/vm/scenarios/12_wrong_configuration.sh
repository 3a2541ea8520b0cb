# SPDX-License-Identifier: Apache-2.0
# What no restart mends is not tried again, and the exit code says what it is.
configure loopback width_px=7
check "with a bad configuration it does not start" bash -c '! systemctl restart darklingd'
sleep 2
check_equal "its exit code says so" 78 "$(property ExecMainStatus)"
check_equal "it is left alone" "failed 0" "$(property ActiveState) $(property NRestarts)"
check "the key is named" service_says "width_px"
configure loopback calibration=/etc/darkling/absent
systemctl reset-failed darklingd
check "without its calibration it does not start" bash -c '! timeout 10 systemctl restart darklingd'
check "the file is named" service_says "/etc/darkling/absent"
