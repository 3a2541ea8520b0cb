# SPDX-License-Identifier: Apache-2.0
# Builds for 32-bit ARM, Debian's armhf (ARMv7, hard float), with Debian's cross compiler. Only the
# kernel files are compiled for NEON, which not every ARMv7 has.
set(CMAKE_SYSTEM_PROCESSOR armv7l)
set(DARKLING_DEBIAN_ARCH armhf)
set(DARKLING_TRIPLET arm-linux-gnueabihf)
set(DARKLING_EMULATOR qemu-arm)
# Notes that arguments are passed otherwise than before GCC 7, which compiled nothing we link.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
include(${CMAKE_CURRENT_LIST_DIR}/cross.cmake)
