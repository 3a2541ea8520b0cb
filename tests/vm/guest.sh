#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs in the guest: installs the staged service as docs/deploy.md says, loads the cameras and runs
# the scenarios one after the other. Each gets a shell and a scratch folder of its own.
set -u

readonly host=/mnt/host assets=/opt/vm results=/mnt/host/results
readonly scenario_limit_s=200

install_service() {
  cp -a "$host/stage/." /
  mkdir -p "$assets" "$results" /etc/darkling
  cp -a "$host/assets/." "$assets"
  cp -a "$assets"/{mine,wide,square} /etc/darkling
  ldconfig
  systemd-sysusers
  udevadm control --reload
  systemctl daemon-reload
  # The guest has no network.
  systemctl enable --quiet --now darkling-lcm-route
}

load_cameras() {
  # Both with fixed nodes, so that no scenario depends on the order in which they load.
  modprobe vivid n_devs=2 node_types=0x1,0x1 num_inputs=1,1 input_types=0x0,0x0 vid_cap_nr=10,11
  modprobe v4l2loopback devices=2 video_nr=20,21 card_label=left,right max_buffers=4
  udevadm settle
}

export assets results
PATH="$assets/bin:$PATH"
install_service
load_cameras
for path in "$host"/scenarios/*.sh; do
  scenario="$(basename "$path" .sh)"
  scratch="$(mktemp -d "/run/$scenario.XXXXXX")"
  scenario_start="$(date +%s)"
  export scenario scratch scenario_start
  timeout --kill-after=5 "$scenario_limit_s" \
    bash -c 'source "$1"; trap stop_feed EXIT; source "$2"' scenario "$host/checks.sh" "$path"
  ended=$?
  if [[ $ended -eq 124 || $ended -eq 137 ]]; then
    echo "FAIL $scenario: it ends within $scenario_limit_s s"
  fi
  systemctl stop darklingd
  mkdir -p "$results/$scenario"
  cp -a "$scratch/." "$results/$scenario"
  echo "     $scenario took $(($(date +%s) - scenario_start)) s"
done
echo "end of all scenarios"
