# SPDX-License-Identifier: MIT
# src/eval/kernels/kernels.cpp is compiled once for each instruction set. Its objects must hold no function that the
# linker could take for another instruction set's: no precompiled header, nothing of the standard library
# (tools/check_kernels looks at their symbols).
set(kernels ${CMAKE_SOURCE_DIR}/src/eval/kernels/kernels.cpp)
# No function of theirs sets errno: where there is no other way to a square root of a pack (pack.h) it is an
# instruction then, and no call.
set_source_files_properties(${kernels} PROPERTIES SKIP_PRECOMPILE_HEADERS ON COMPILE_OPTIONS -fno-math-errno)

function(rigc_kernels isa)
  add_library(rigc_kernels_${isa} OBJECT ${kernels})
  target_include_directories(rigc_kernels_${isa} PRIVATE ${CMAKE_SOURCE_DIR}/src)
  target_link_libraries(rigc_kernels_${isa} PRIVATE rigc_flags)
  target_compile_definitions(rigc_kernels_${isa} PRIVATE RIGC_ISA=${isa})
  target_compile_options(rigc_kernels_${isa} PRIVATE ${ARGN})
  set(rigc_kernel_objects ${rigc_kernel_objects} $<TARGET_OBJECTS:rigc_kernels_${isa}> PARENT_SCOPE)
endfunction()

rigc_kernels(baseline)
target_sources(rigc_eval PRIVATE $<TARGET_OBJECTS:rigc_kernels_baseline>)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  rigc_kernels(avx2 -mavx2)
  target_sources(rigc_eval PRIVATE $<TARGET_OBJECTS:rigc_kernels_avx2>)
  target_compile_definitions(rigc_eval PRIVATE RIGC_HAS_AVX2)
endif()
