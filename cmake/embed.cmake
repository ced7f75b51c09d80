# SPDX-License-Identifier: MIT
# Compiles modules.d/ and shapes/ into the catalogue. rigc_catalog holds the readers and asks for tables that the
# generated file defines; rigc_embed, which makes that file, needs the readers alone. So the tables are a library of
# their own that users of rigc_catalog link too, and rigc_embed links the readers' archive without it.
file(GLOB rigc_module_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/modules.d/*.yaml)
file(GLOB rigc_shape_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shapes/*.yaml)

add_executable(rigc_embed ${CMAKE_SOURCE_DIR}/tools/embed.cpp)
add_dependencies(rigc_embed rigc_catalog)
target_link_libraries(rigc_embed PRIVATE $<TARGET_FILE:rigc_catalog> rigc_base rigc_math)

set(rigc_catalog_tables ${CMAKE_BINARY_DIR}/catalog_tables.cpp)
add_custom_command(OUTPUT ${rigc_catalog_tables}
  COMMAND rigc_embed ${rigc_catalog_tables} ${rigc_module_files} --shapes ${rigc_shape_files}
  DEPENDS rigc_embed ${rigc_module_files} ${rigc_shape_files}
  COMMENT "Embedding modules.d and shapes" VERBATIM)

add_library(rigc_catalog_tables STATIC ${rigc_catalog_tables})
target_include_directories(rigc_catalog_tables PRIVATE ${CMAKE_SOURCE_DIR}/src)
target_link_libraries(rigc_catalog_tables PRIVATE rigc_flags fmt::fmt)
target_link_libraries(rigc_catalog INTERFACE rigc_catalog_tables)
