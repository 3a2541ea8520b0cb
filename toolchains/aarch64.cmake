# SPDX-License-Identifier: Apache-2.0
# Builds for 64-bit ARM, Debian's arm64, with Debian's cross compiler.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(DARKLING_DEBIAN_ARCH arm64)
set(DARKLING_TRIPLET aarch64-linux-gnu)
set(DARKLING_EMULATOR qemu-aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/cross.cmake)
