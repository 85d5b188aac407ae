# Writes outrider.pc, for builds without CMake: `pkg-config --cflags --libs outrider` gives all layers, and what they
# link: of each layer packages that pkg-config knows, or else libraries. Some of these packages ask for an older C++, so
# users put `-std=c++20` behind the flags.
set(pc_name_of_fmt::fmt fmt)
set(pc_name_of_TBB::tbb tbb)
set(pc_name_of_Eigen3::Eigen eigen3)
set(pc_name_of_apriltag::apriltag apriltag)
set(pc_name_of_yaml-cpp yaml-cpp)
set(pc_name_of_pugixml::pugixml pugixml)
set(pc_name_of_PNG::PNG libpng)
set(pc_name_of_ZLIB::ZLIB zlib)
set(pc_name_of_CycloneDDS::ddsc CycloneDDS)
set(pc_name_of_SQLite::SQLite3 sqlite3)
set(pc_name_of_dart dart)
set(flag_of_Threads::Threads -pthread)
set(flag_of_BZip2::BZip2 -lbz2)
set(flag_of_dart-collision-ode -ldart-collision-ode)
set(headers_only tl::expected)

set(pc_layers "")
set(pc_requires "")
set(pc_flags "")
foreach(layer IN LISTS layers)
  list(PREPEND pc_layers "-l${layer}")  # a layer stands before those that it uses
  get_target_property(links ${layer} INTERFACE_LINK_LIBRARIES)
  foreach(library IN LISTS links)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" library "${library}")
    if(NOT library OR library MATCHES "BUILD_INTERFACE:|^outrider(_|::)" OR library IN_LIST headers_only)
      continue()
    elseif(DEFINED pc_name_of_${library})
      list(APPEND pc_requires ${pc_name_of_${library}})
    elseif(DEFINED flag_of_${library})
      list(APPEND pc_flags ${flag_of_${library}})
    elseif(TARGET ${library} OR library MATCHES "::")
      message(FATAL_ERROR "${layer} links ${library}: say in cmake/PkgConfig.cmake what pkg-config calls it")
    else()
      string(REGEX REPLACE "^.*/lib([^/]*)\\.(so|a)$" "\\1" library "${library}")
      list(APPEND pc_flags -l${library})
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES pc_requires)
list(REMOVE_DUPLICATES pc_flags)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE pc_up)
list(JOIN pc_layers " " pc_layers)
list(JOIN pc_requires ", " pc_requires)
list(JOIN pc_flags " " pc_flags)

file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/outrider.pc @ONLY CONTENT
"prefix=\${pcfiledir}/@pc_up@
libdir=\${prefix}/@CMAKE_INSTALL_LIBDIR@
includedir=\${prefix}/@CMAKE_INSTALL_INCLUDEDIR@

Name: outrider
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Requires: @pc_requires@
Cflags: -I\${includedir}
Libs: -L\${libdir} @pc_layers@ @pc_flags@
")
install(FILES ${PROJECT_BINARY_DIR}/outrider.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
