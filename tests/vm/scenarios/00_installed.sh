# SPDX-License-Identifier: Apache-2.0
# What was installed is found by systemd, udev and the loader, and the service's user may use cameras.
check "every library of the service and of its module is there" \
  bash -c '! ldd /usr/bin/darklingd /usr/lib/darkling/darkling_libcamera.so | grep "not found"'
check "systemd finds the unit" systemctl cat darklingd
check "its user is in the group of cameras" bash -c 'id -nG darkling | grep -qw video'
check "nodes of cameras belong to that group" \
  bash -c '[[ "$(stat -c %G:%a /dev/video10)" == video:660 ]]'
check "the rules are read and make a unit of a camera" wait_until 5 systemctl is-active dev-video10.device
check "nobody owns a file outside its place" \
  bash -c '[[ -z "$(find /usr/bin/darklingd /usr/lib/systemd/system/darkling* ! -user root)" ]]'
rm -f "$config"
check "without a configuration it does not start" bash -c '! systemctl start darklingd'
check_equal "and it is not tried again" 0 "$(property NRestarts)"
