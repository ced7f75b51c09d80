# SPDX-License-Identifier: MIT
# librigc_eval.so, the C ABI of src/capi, and what is installed for those who use it: header, pkg-config file
# (rigc_eval) and CMake package (find_package(rigc_eval), target rigc::eval). Test: tests/tools/eval_library_test
include(CMakePackageConfigHelpers)
target_compile_definitions(rigc_capi PRIVATE RIGC_VERSION="${PROJECT_VERSION}")

# The ABI's number stands in the header alone.
file(STRINGS src/capi/rigc_eval.h rigc_eval_abi REGEX "^#define RIGC_EVAL_ABI [0-9]+$")
string(REGEX REPLACE "[^0-9]" "" rigc_eval_abi "${rigc_eval_abi}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS src/capi/rigc_eval.h)

add_library(rigc_eval_shared SHARED $<TARGET_OBJECTS:rigc_capi>)
target_link_libraries(rigc_eval_shared PRIVATE rigc_flags rigc_gltf rigc_eval)
set(rigc_eval_exports ${CMAKE_SOURCE_DIR}/src/capi/rigc_eval.map)
target_link_options(rigc_eval_shared PRIVATE LINKER:--version-script=${rigc_eval_exports} LINKER:--as-needed)
target_include_directories(rigc_eval_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
set_target_properties(rigc_eval_shared PROPERTIES OUTPUT_NAME rigc_eval EXPORT_NAME eval LINKER_LANGUAGE CXX
  SOVERSION ${rigc_eval_abi} VERSION ${rigc_eval_abi}.${PROJECT_VERSION} LINK_DEPENDS ${rigc_eval_exports})

# The installed tree may be moved: the pkg-config file finds it from where it stands itself.
set(pkgconfig_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH rigc_eval_prefix /${pkgconfig_folder} /)
configure_file(cmake/rigc_eval.pc.in ${CMAKE_BINARY_DIR}/rigc_eval.pc @ONLY)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/rigc_eval-config-version.cmake COMPATIBILITY SameMinorVersion)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/rigc_eval)
install(TARGETS rigc_eval_shared EXPORT rigc_eval COMPONENT library)
install(FILES src/capi/rigc_eval.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)
install(FILES ${CMAKE_BINARY_DIR}/rigc_eval.pc DESTINATION ${pkgconfig_folder} COMPONENT library)
install(FILES ${CMAKE_BINARY_DIR}/rigc_eval-config-version.cmake DESTINATION ${package_folder} COMPONENT library)
install(EXPORT rigc_eval FILE rigc_eval-config.cmake NAMESPACE rigc:: DESTINATION ${package_folder} COMPONENT library)
