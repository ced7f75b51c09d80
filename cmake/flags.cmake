# SPDX-License-Identifier: MIT
# Compiler flags of every target. The floating-point ones are what law 1 (same bytes everywhere) rests on.
add_library(rigc_flags INTERFACE)
target_compile_features(rigc_flags INTERFACE cxx_std_20)
target_compile_options(rigc_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
  -Wnon-virtual-dtor -Wimplicit-fallthrough -ffp-contract=off -fno-fast-math
  $<$<BOOL:${RIGC_WERROR}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms of gcc 12 inside std::string (its bugs 105329 and 105651).
  target_compile_options(rigc_flags INTERFACE -Wno-stringop-overflow -Wno-restrict -Wno-array-bounds)
endif()
target_compile_definitions(rigc_flags INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY)
if(RIGC_SANITIZE)
  target_compile_options(rigc_flags INTERFACE -fsanitize=${RIGC_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(rigc_flags INTERFACE -fsanitize=${RIGC_SANITIZE})
endif()

# ccache, where it is installed. These settings let it reuse objects that were made with a precompiled header.
find_program(RIGC_CCACHE ccache)
if(RIGC_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${RIGC_CCACHE})
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  target_compile_options(rigc_flags INTERFACE "SHELL:-Xclang -fno-pch-timestamp")
endif()
