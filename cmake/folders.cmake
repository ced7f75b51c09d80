# SPDX-License-Identifier: MIT
# rigc_folder(NAME FOLDER...): the library of src/NAME, which may include the folders named after it.
function(rigc_folder name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS src/${name}/*.cpp)
  list(FILTER sources EXCLUDE REGEX /kernels/kernels.cpp$)  # cmake/kernels.cmake
  if(NOT sources)
    add_library(rigc_${name} INTERFACE)
    set(scope INTERFACE)
  else()
    add_library(rigc_${name} STATIC ${sources})
    set(scope PUBLIC)
    if(name STREQUAL base)
      target_precompile_headers(rigc_base PRIVATE <algorithm> <array> <cmath> <cstdint> <cstring>
        <functional> <map> <memory> <optional> <set> <string> <string_view> <unordered_map> <utility>
        <variant> <vector> <fmt/format.h>)
    else()
      target_precompile_headers(rigc_${name} REUSE_FROM rigc_base)
    endif()
  endif()
  target_include_directories(rigc_${name} ${scope} ${CMAKE_SOURCE_DIR}/src)
  target_link_libraries(rigc_${name} ${scope} rigc_flags fmt::fmt)
  foreach(below ${ARGN})
    target_link_libraries(rigc_${name} ${scope} rigc_${below})
  endforeach()
endfunction()
