# SPDX-License-Identifier: Apache-2.0
# What the toolchain files for Debian on ARM share. They set before they include it:
#   DARKLING_DEBIAN_ARCH   Debian's name of the architecture
#   DARKLING_TRIPLET       the compiler's prefix and the name of the library folders
#   DARKLING_EMULATOR      the emulator's program
# -DDARKLING_SYSROOT=DIR names another sysroot than the usual one, build/sysroot/ARCH.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_CXX_COMPILER ${DARKLING_TRIPLET}-g++)

get_filename_component(usual_sysroot ${CMAKE_CURRENT_LIST_DIR}/../build/sysroot/${DARKLING_DEBIAN_ARCH} ABSOLUTE)
set(DARKLING_SYSROOT ${usual_sysroot} CACHE PATH "Headers and libraries of the target, made by toolchains/sysroot.sh")
# CMake reads this file again for its trial builds, which see no cache of ours.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES DARKLING_SYSROOT)

# The last file that sysroot.sh writes; it says what for.
set(sysroot_arch "")
if(EXISTS ${DARKLING_SYSROOT}/.darkling-sysroot)
  file(STRINGS ${DARKLING_SYSROOT}/.darkling-sysroot sysroot_arch REGEX "^arch ")
endif()
if(NOT sysroot_arch STREQUAL "arch ${DARKLING_DEBIAN_ARCH}")
  message(FATAL_ERROR "There is no complete sysroot for ${DARKLING_DEBIAN_ARCH} in ${DARKLING_SYSROOT}. Make it with\n"
    "  toolchains/sysroot.sh ${DARKLING_DEBIAN_ARCH} ${DARKLING_SYSROOT}\n"
    "or name another with -DDARKLING_SYSROOT=DIR.")
endif()
set(CMAKE_SYSROOT ${DARKLING_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR}
    ${CMAKE_SYSROOT}/usr/lib/${DARKLING_TRIPLET}/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)

# Libraries that our libraries need are found by the linker only when told where.
foreach(folder lib usr/lib)
  string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -Wl,-rpath-link,${CMAKE_SYSROOT}/${folder}/${DARKLING_TRIPLET}")
endforeach()

find_program(DARKLING_EMULATOR_PROGRAM ${DARKLING_EMULATOR})
if(DARKLING_EMULATOR_PROGRAM)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${DARKLING_EMULATOR_PROGRAM} -L ${CMAKE_SYSROOT})
endif()
