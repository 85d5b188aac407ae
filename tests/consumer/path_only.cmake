# A project that asks for path builds and runs where the packages that only other components need do not exist, nor
# the headers of any library that path uses in its source files.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
find_program(ninja ninja REQUIRED)

# Without what no component needs, but the tool does, and without TBB's package: its library alone must do.
include(${BUILD}/outriderComponents.cmake)
set(hidden TBB Boost nlohmann_json CLI11 civetweb ompl)
foreach(component IN LISTS outrider_components)
  list(APPEND hidden ${outrider_packages_of_${component}})
endforeach()
list(TRANSFORM hidden REPLACE " .*" "")
list(REMOVE_DUPLICATES hidden)
set(needed ${outrider_packages_of_path})
list(REMOVE_ITEM needed TBB)
list(REMOVE_ITEM hidden ${needed})
foreach(package yaml-cpp pugixml apriltag PNG Eigen3)
  if(NOT package IN_LIST hidden)
    message(FATAL_ERROR "path needs ${package}: ${outrider_packages_of_path}")
  endif()
endforeach()
list(TRANSFORM hidden REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON")
configure_project(path_only ${hidden})

# If the system allows it, nothing is mounted over their headers. Otherwise the list of the headers read has to do.
set(headers tbb oneapi boost yaml-cpp sdformat* dart apriltag nlohmann eigen3 ompl* CLI polyclipping png.h libpng*
  pugixml.hpp turbojpeg.h zlib.h civetweb.h)
list(TRANSFORM headers PREPEND /usr/include/)
file(GLOB headers ${headers})
set(prefix "")
execute_process(COMMAND unshare --mount mount --make-rprivate / RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(status EQUAL 0)
  list(JOIN headers ":" headers)
  file(MAKE_DIRECTORY ${TRIAL}/empty)
  set(prefix unshare --mount sh ${here}/cover.sh ${TRIAL}/empty ${headers})
else()
  message(STATUS "headers cannot be covered here; only which were read is checked")
endif()
step("building" ${prefix} ${CMAKE_COMMAND} --build ${TRIAL}/path_only)

step("listing the headers" ${ninja} -C ${TRIAL}/path_only -t deps)
if(NOT output MATCHES "outrider/path/catalog.hpp")
  message(FATAL_ERROR "the list of headers that were read is not what it should be:\n${output}")
endif()
string(REGEX MATCHALL
  "[^\n]*/(tbb|oneapi|boost|yaml-cpp|sdf|sdformat-[^/\n]*|dart|apriltag|nlohmann|eigen3|Eigen|ompl[^/\n]*|CLI|polyclipping|png\\.h|zlib\\.h|pugixml\\.hpp|turbojpeg\\.h|fmt)(/[^\n]*)?"
  read "${output}")
if(read)
  message(FATAL_ERROR "headers were read that path should do without:\n${read}")
endif()
string(REGEX MATCHALL "include/outrider/[a-z]+" layers "${output}")
list(TRANSFORM layers REPLACE ".*/" "")
list(REMOVE_DUPLICATES layers)
list(REMOVE_ITEM layers ${outrider_layers_of_path})
if(layers)
  message(FATAL_ERROR "headers of other layers were read: ${layers}")
endif()

expect_output(path_only/path_only "7.27672 m in 3 legs\n")
