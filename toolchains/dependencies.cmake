# SPDX-License-Identifier: Apache-2.0
# Third-party libraries, each as one imported target, found once and as SYSTEM (no warnings of theirs).

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(tl-expected REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
if(DARKLING_DESK_TOOL)
  find_package(OpenSSL REQUIRED COMPONENTS Crypto)
endif()

# Debian's OpenCVConfig.cmake comes only with the full libopencv-dev; we need four of its libraries.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
foreach(component core imgproc imgcodecs calib3d)
  find_library(OPENCV_${component}_LIBRARY opencv_${component})
  if(OPENCV_${component}_LIBRARY)
    add_library(opencv::${component} UNKNOWN IMPORTED)
    set_target_properties(opencv::${component} PROPERTIES
      IMPORTED_LOCATION ${OPENCV_${component}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${OPENCV_INCLUDE_DIR}
      INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${OPENCV_INCLUDE_DIR})
  endif()
endforeach()

# Without it the service tells nobody how it is, and has no watchdog.
find_path(SYSTEMD_INCLUDE_DIR systemd/sd-daemon.h)
find_library(SYSTEMD_LIBRARY systemd)
if(SYSTEMD_INCLUDE_DIR AND SYSTEMD_LIBRARY)
  add_library(systemd::systemd UNKNOWN IMPORTED)
  set_target_properties(systemd::systemd PROPERTIES
    IMPORTED_LOCATION ${SYSTEMD_LIBRARY}
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${SYSTEMD_INCLUDE_DIR})
else()
  message(STATUS "Built without libsystemd-dev: no notification of systemd")
endif()

# Without it cameras that send JPEG images only are refused.
find_package(JPEG)
if(NOT JPEG_FOUND)
  message(STATUS "Built without libjpeg62-turbo-dev: no MJPEG of cameras")
endif()

# Without it there are no cameras through libcamera.
find_path(LIBCAMERA_INCLUDE_DIR libcamera/camera_manager.h PATH_SUFFIXES libcamera)
find_library(LIBCAMERA_LIBRARY camera)
find_library(LIBCAMERA_BASE_LIBRARY camera-base)
if(LIBCAMERA_INCLUDE_DIR AND LIBCAMERA_LIBRARY AND LIBCAMERA_BASE_LIBRARY)
  add_library(libcamera::libcamera UNKNOWN IMPORTED)
  set_target_properties(libcamera::libcamera PROPERTIES
    IMPORTED_LOCATION ${LIBCAMERA_LIBRARY}
    INTERFACE_LINK_LIBRARIES ${LIBCAMERA_BASE_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LIBCAMERA_INCLUDE_DIR}
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${LIBCAMERA_INCLUDE_DIR})
else()
  message(STATUS "Built without libcamera-dev: no cameras through libcamera")
endif()

# LCM ships no CMake package, and its lcm.pc asks for the development files of glib, which only LCM
# itself uses. Generated messages need one header of it and no library. The generator is the host's
# in cross builds too.
find_path(LCM_INCLUDE_DIR lcm/lcm_coretypes.h REQUIRED)
find_library(LCM_LIBRARY lcm REQUIRED)
find_program(LCM_GEN_PROGRAM lcm-gen REQUIRED)
add_library(lcm::coretypes INTERFACE IMPORTED)
set_target_properties(lcm::coretypes PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
add_library(lcm::lcm UNKNOWN IMPORTED)
set_target_properties(lcm::lcm PROPERTIES
  IMPORTED_LOCATION ${LCM_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR}
  INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
