# A layer is one folder under src/ and include/outrider/, and one target outrider_<name>. The folder
# jobs/guard becomes outrider_jobs_guard, outrider::jobs_guard. The layer `research` stands apart: its folder at the top has
# headers (`research/NAME.hpp`) and sources together, and is not installed.
#
# The compiler sees its headers only through its own target: each layer has an include tree with only its own
# folder, so a file that includes a layer it does not link to does not compile.
#
#   outrider_layer(NAME world SOURCES solid.cpp ... USES geometry core PRIVATE fmt::fmt)
#
# PUBLIC names third-party libraries that the layer's headers include; PRIVATE those that only its source
# files include. Each layer is a component of the installed package, whose needs follow from these lists
# (Install.cmake).
#
# CHECKED enables container checks in releases too (Harden.cmake). Quick builds join the files of a folder
# (Precompile.cmake); ALONE names the files that are compiled one by one there too: those that instantiate large
# templates, which take more time and much more memory together.

function(outrider_layer)
  cmake_parse_arguments(LAYER "CHECKED" "NAME" "SOURCES;ALONE;USES;PUBLIC;PRIVATE" ${ARGN})
  string(REPLACE / _ name ${LAYER_NAME})
  set(target outrider_${name})
  set(tree ${PROJECT_BINARY_DIR}/layers/${name})
  if(LAYER_NAME STREQUAL "research")
    set(sources ${PROJECT_SOURCE_DIR}/research)
    set(headers ${sources})
    set(seen_as ${tree}/research)
  else()
    set(sources ${PROJECT_SOURCE_DIR}/src/${LAYER_NAME})
    set(headers ${PROJECT_SOURCE_DIR}/include/outrider/${LAYER_NAME})
    set(seen_as ${tree}/outrider/${LAYER_NAME})
  endif()
  cmake_path(GET seen_as PARENT_PATH parent)
  file(MAKE_DIRECTORY ${parent})
  file(CREATE_LINK ${headers} ${seen_as} SYMBOLIC)

  add_library(${target} STATIC)
  list(TRANSFORM LAYER_SOURCES PREPEND ${sources}/)
  list(TRANSFORM LAYER_ALONE PREPEND ${sources}/)
  target_sources(${target} PRIVATE ${LAYER_SOURCES} ${LAYER_ALONE})
  set_source_files_properties(${LAYER_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_library(outrider::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${tree}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${sources})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE ${OUTRIDER_WARNINGS})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name}
    POSITION_INDEPENDENT_CODE ON)
  list(TRANSFORM LAYER_USES REPLACE / _)
  list(TRANSFORM LAYER_USES PREPEND outrider_)
  target_link_libraries(${target} PUBLIC ${LAYER_USES} ${LAYER_PUBLIC})
  foreach(library IN LISTS LAYER_PRIVATE)
    outrider_has_only_headers(headers_only ${library})
    if(headers_only)
      target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${library}>)
    else()
      target_link_libraries(${target} PRIVATE ${library})
    endif()
  endforeach()
  if(LAYER_CHECKED)
    outrider_check_containers(${target})
    outrider_precompile(${target} checked_layers)
  else()
    outrider_precompile(${target} layers)
  endif()
  outrider_join_folders(${target})
  if(NOT LAYER_NAME STREQUAL "research")
    set_property(GLOBAL APPEND PROPERTY OUTRIDER_LAYERS ${target})
  endif()
endfunction()

# Sets `result` to true if a library has nothing to link after our sources are compiled, so users of the
# installed layer do not need it. The threads library counts as linked, because its content depends on the
# system.
function(outrider_has_only_headers result library)
  set(${result} FALSE PARENT_SCOPE)
  if(TARGET ${library} AND NOT library STREQUAL "Threads::Threads")
    get_target_property(type ${library} TYPE)
    get_target_property(links ${library} INTERFACE_LINK_LIBRARIES)
    if(type STREQUAL "INTERFACE_LIBRARY" AND NOT links)
      set(${result} TRUE PARENT_SCOPE)
    endif()
  endif()
endfunction()

set(OUTRIDER_WARNINGS -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
# Disables fused multiply-add, so that every compiler gives the same arithmetic.
add_compile_options(-ffp-contract=off)
