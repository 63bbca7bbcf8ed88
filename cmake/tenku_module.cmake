# Flags and helpers that every module shares.
#
# tenku_module(name HEADERS ... SOURCES ... PUBLIC ... PRIVATE ...) makes the static library
# tenku_<name>. PUBLIC and PRIVATE name other modules (without the prefix) or imported targets.
# Each header is also compiled alone, so that it includes what it needs (target header_checks).
#
# tenku_compile_quickly(target): for code that only calls others (options, tests), where -O3 costs
# twice the time of compiling and gains nothing.
#
# tenku_plugin(name SOURCES ... USED_BY module PRIVATE ...) makes the library that core/plugin.h
# loads under that name, and has it built with the module that asks for it.

find_program(TENKU_CCACHE ccache)
if(TENKU_CCACHE)
  # Else it does not know headers that are compiled ahead.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
      ${TENKU_CCACHE})
endif()

add_library(tenku_options INTERFACE)
target_compile_options(tenku_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off
                       -fno-math-errno)
target_include_directories(tenku_options INTERFACE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
if(TENKU_SANITIZE)
  target_compile_options(tenku_options INTERFACE -fsanitize=address,undefined
                         -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(tenku_options INTERFACE -fsanitize=address,undefined)
endif()
if(TENKU_FUZZ)
  target_compile_options(tenku_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                         -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(tenku_options INTERFACE -fsanitize=address,undefined)
endif()

# What nearly every source includes, compiled ahead: a second a source. Each still names what it uses.
set(TENKU_COMMON_HEADERS <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <span>
    <sstream> <string> <string_view> <unordered_map> <utility> <vector>)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/common_headers.cpp CONTENT "")
add_library(tenku_common_headers OBJECT ${PROJECT_BINARY_DIR}/common_headers.cpp)
target_link_libraries(tenku_common_headers PRIVATE tenku_options)
target_precompile_headers(tenku_common_headers PRIVATE ${TENKU_COMMON_HEADERS})

add_custom_target(header_checks)

function(tenku_link target scope)
  foreach(library IN LISTS ARGN)
    if(TARGET tenku_${library} AND NOT library STREQUAL "tenku")
      target_link_libraries(${target} ${scope} tenku_${library})
    else()
      target_link_libraries(${target} ${scope} ${library})
    endif()
  endforeach()
endfunction()

function(tenku_module name)
  cmake_parse_arguments(M "" "" "HEADERS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(tenku_${name} STATIC ${M_SOURCES} ${M_HEADERS})
  target_link_libraries(tenku_${name} PUBLIC tenku_options)
  tenku_link(tenku_${name} PUBLIC ${M_PUBLIC})
  tenku_link(tenku_${name} PRIVATE ${M_PRIVATE})
  target_precompile_headers(tenku_${name} REUSE_FROM tenku_common_headers)

  set(units)
  foreach(header IN LISTS M_HEADERS)
    file(RELATIVE_PATH relative ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${header})
    string(REGEX REPLACE "^src/" "" include ${relative})
    string(MAKE_C_IDENTIFIER ${include} id)
    set(unit ${CMAKE_BINARY_DIR}/header_checks/${id}.cpp)
    file(CONFIGURE OUTPUT ${unit} CONTENT "#include \"${include}\"\n")
    list(APPEND units ${unit})
  endforeach()
  if(units)
    add_library(header_checks_${name} OBJECT EXCLUDE_FROM_ALL ${units})
    target_link_libraries(header_checks_${name} PRIVATE tenku_options)
    add_dependencies(header_checks header_checks_${name})
  endif()
endfunction()

function(tenku_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

set(TENKU_PLUGIN_FOLDER ${PROJECT_BINARY_DIR}/lib/tenku)

function(tenku_plugin name)
  cmake_parse_arguments(P "" "USED_BY" "SOURCES;PRIVATE" ${ARGN})
  add_library(plugin_${name} MODULE ${P_SOURCES})
  target_link_libraries(plugin_${name} PRIVATE tenku_options ${P_PRIVATE})
  set_target_properties(plugin_${name} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name}-${PROJECT_VERSION}
    LIBRARY_OUTPUT_DIRECTORY ${TENKU_PLUGIN_FOLDER})
  add_dependencies(tenku_${P_USED_BY} plugin_${name})
  install(TARGETS plugin_${name} LIBRARY DESTINATION lib/tenku)
endfunction()
