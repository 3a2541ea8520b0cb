# SPDX-License-Identifier: Apache-2.0
# Compiler flags that every target shares, on `darkling_flags`.
#
# -ffp-contract=off: a fused multiply-add rounds once where two operations round twice; without
# this flag x86 and AArch64 disagree in the last bit, and so would our trajectories.
# No -march=native: the instruction set is chosen at run time, per kernel file.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # Precompiled headers are cached only with these.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

set(DARKLING_SANITIZE "" CACHE STRING "Sanitizers for every target: empty, address,undefined or thread")

add_library(darkling_flags INTERFACE)
target_compile_options(darkling_flags INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wcast-align -Werror)
# GCC 12 sees overflows in `"text" + std::string` at -O3 that are not there (GCC bug 105651).
target_compile_options(darkling_flags INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>)
# Eigen vectorised differs between machines in the last bit, and asks for aligned members.
target_compile_definitions(darkling_flags INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY)
target_include_directories(darkling_flags INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
if(DARKLING_SANITIZE)
  target_compile_options(darkling_flags INTERFACE
    -fsanitize=${DARKLING_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(darkling_flags INTERFACE -fsanitize=${DARKLING_SANITIZE})
endif()
if(DARKLING_FUZZ)
  # clang can be there without the library of its fuzzer.
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_FLAGS -fsanitize=fuzzer)
  check_cxx_source_compiles("
    extern \"C\" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }"
    DARKLING_HAS_LIBFUZZER)
  unset(CMAKE_REQUIRED_FLAGS)
endif()
if(DARKLING_FUZZ AND DARKLING_HAS_LIBFUZZER)
  target_compile_options(darkling_flags INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(darkling_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# For the layers that run every frame: no function may take more stack than this. The largest
# today are functions of the start, with 5 KiB.
add_library(darkling_bounded_stack INTERFACE)
if(NOT DARKLING_SANITIZE)
  target_compile_options(darkling_bounded_stack INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-Wstack-usage=8192>)
endif()

# darkling_layer(NAME [HEADERS_TO_PRECOMPILE...]): the static library darkling_NAME of every .cpp in
# this folder.
function(darkling_layer name)
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  add_library(darkling_${name} STATIC ${sources})
  target_link_libraries(darkling_${name} PUBLIC darkling_flags)
  if(ARGN)
    target_precompile_headers(darkling_${name} PRIVATE ${ARGN})
  endif()
endfunction()
