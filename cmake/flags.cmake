# SPDX-License-Identifier: MIT
# Compiler flags of every target. The floating-point ones are what law 1 (same bytes everywhere) rests on.
add_library(rigc_flags INTERFACE)
target_compile_features(rigc_flags INTERFACE cxx_std_20)
target_compile_options(rigc_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
  -Wnon-virtual-dtor -Wimplicit-fallthrough -ffp-contract=off -fno-fast-math
  $<$<BOOL:${RIGC_WERROR}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # gcc 12 drops the rounding of double -> float -> double where it vectorises straight-line code:
  # double(float(p.x)), double(float(p.y)) in one expression keep all their digits. Loops are not affected.
  target_compile_options(rigc_flags INTERFACE -fno-tree-slp-vectorize)
  # What it concludes from inlining std::string, std::optional and std::variant is often false (its bugs 105329,
  # 105651, 105562). Clang's sanitizers watch for the real ones.
  target_compile_options(rigc_flags INTERFACE -Wno-array-bounds -Wno-free-nonheap-object -Wno-maybe-uninitialized
    -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()
# Every object may become a part of librigc_eval.so. None of its functions is replaced by another's at run time, so
# that they are called and inlined as in a program.
target_compile_options(rigc_flags INTERFACE -fPIC -fno-semantic-interposition)
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
