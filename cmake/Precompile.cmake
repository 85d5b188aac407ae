# Precompiles the headers that most files include, once for all targets of a group, which share their flags:
#
#   outrider_precompile(unit_world tests HEADERS <gtest/gtest.h> LINKS GTest::gtest)
#
# The first target of a group sets the flags; HEADERS and LINKS are further headers and libraries of the
# group. outrider_join(target) compiles its files eight at a time, which a target of many short files with
# large headers gains most from. outrider_join_folders(target) joins the files of each folder instead, at most ten at a
# time: a new file then compiles only its own folder again, and names need to differ only within a folder.
#
# The code does not depend on either: each file includes what it uses and hides no name, which `make lint` checks
# with clang++, file by file. Files that are joined see each other's unnamed namespaces, so a name there stands
# for one thing in what is joined.
# Builds with ccache, which does not cache files with precompiled headers, work without both.
option(OUTRIDER_QUICK_BUILD "Parse the headers that most files include once for many files" OFF)

function(outrider_join target)
  if(OUTRIDER_QUICK_BUILD AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    # A name in one file may hide a private one of another; and g++ takes joined files for headers.
    target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

function(outrider_join_folders target)
  outrider_join(${target})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  set(folders)
  foreach(source IN LISTS sources)
    get_source_file_property(alone ${source} SKIP_UNITY_BUILD_INCLUSION)
    if(alone)
      continue()
    endif()
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER ${folder} folder)
    list(APPEND folders ${folder})
    list(APPEND files_of_${folder} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    list(LENGTH files_of_${folder} files)
    math(EXPR groups "(${files} + 9) / 10")
    math(EXPR size "(${files} + ${groups} - 1) / ${groups}")
    set(index 0)
    foreach(source IN LISTS files_of_${folder})
      math(EXPR group "${index} / ${size}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${group})
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
endfunction()

function(outrider_precompile target group)
  if(NOT OUTRIDER_QUICK_BUILD OR CMAKE_CXX_COMPILER_LAUNCHER)
    return()
  endif()
  cmake_parse_arguments(GROUP "" "" "HEADERS;LINKS" ${ARGN})
  set(headers outrider_headers_of_${group})
  if(NOT TARGET ${headers})
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/pch/${group}.cpp CONTENT "")
    add_library(${headers} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/pch/${group}.cpp)
    target_precompile_headers(${headers} PRIVATE <algorithm> <array> <cmath> <functional> <limits> <map>
      <memory> <optional> <set> <span> <sstream> <string> <variant> <vector> <fmt/format.h> <tl/expected.hpp>
      ${GROUP_HEADERS})
    target_link_libraries(${headers} PRIVATE fmt::fmt ${GROUP_LINKS})
    get_target_property(options ${target} COMPILE_OPTIONS)
    target_compile_options(${headers} PRIVATE ${options})
    get_target_property(pic ${target} POSITION_INDEPENDENT_CODE)
    set_target_properties(${headers} PROPERTIES POSITION_INDEPENDENT_CODE ${pic})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${headers})
  # The macros used to compile the headers must hold for every file that uses them.
  target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
endfunction()
