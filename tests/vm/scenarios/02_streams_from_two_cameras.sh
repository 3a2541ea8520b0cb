# SPDX-License-Identifier: Apache-2.0
# Two cameras of the kernel's own test driver, which nothing keeps in step.
configure vivid
start_service
check_heard "frames arrive" 40 "VO_STATUS state!=NO_CAMERA frames_in>10"
check_equal "no image is of the wrong size" 0 "$(heard VO_STATUS frames_bad)"
