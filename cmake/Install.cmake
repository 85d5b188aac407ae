# Defines what `cmake --install` installs: the headers, one static library per layer, the tool, and a package
# for find_package(outrider). Users link outrider::outrider, or only the layers they want:
#
#   find_package(outrider REQUIRED COMPONENTS path)    # outrider::path, and the layers it uses
#
# Each layer is a component with its own export set, so the targets of other components, and the packages that
# only those need, need not exist. The needs of a component are read from the links of its target.
# tests/consumer is an example user.
#
# `cmake --install build --component tool` installs the tool alone, `dev` what users of the library need, and
# `python` the Python package, which is left out unless it is named. Package.cmake makes Debian packages of them.
include(CMakePackageConfigHelpers)

get_property(layers GLOBAL PROPERTY OUTRIDER_LAYERS)

# Maps each third-party library that layers link to its find_package() arguments.
set(package_of_tl::expected "tl-expected")
set(package_of_fmt::fmt "fmt")
set(package_of_Threads::Threads "Threads")
set(package_of_TBB::tbb "TBB")
set(package_of_Eigen3::Eigen "Eigen3 NO_MODULE")
set(package_of_apriltag::apriltag "apriltag")
set(package_of_nlohmann_json::nlohmann_json "nlohmann_json")
set(package_of_yaml-cpp "yaml-cpp")
set(package_of_pugixml::pugixml "pugixml")
set(package_of_PNG::PNG "PNG")
set(package_of_ZLIB::ZLIB "ZLIB")
set(package_of_BZip2::BZip2 "BZip2")
set(package_of_CycloneDDS::ddsc "CycloneDDS")
set(package_of_SQLite::SQLite3 "SQLite3")
set(package_of_dart "DART COMPONENTS collision-ode")
set(package_of_dart-collision-ode "DART COMPONENTS collision-ode")

# Sets `uses` to the layers that a target links, as components, and `needs` to the find_package() arguments.
# Library files, and names that only the linker knows, need no package.
function(outrider_read_links target uses needs)
  set(layers_used "")
  set(packages "")
  get_target_property(links ${target} INTERFACE_LINK_LIBRARIES)
  foreach(library IN LISTS links)
    if(library MATCHES "BUILD_INTERFACE:" OR NOT library)
      continue()
    endif()
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" library "${library}")
    if(library MATCHES "^outrider(_|::)(.+)$")
      list(APPEND layers_used ${CMAKE_MATCH_2})
    elseif(DEFINED package_of_${library})
      list(APPEND packages "${package_of_${library}}")
    elseif(TARGET ${library} OR library MATCHES "::")
      message(FATAL_ERROR "${target} links ${library}: say in cmake/Install.cmake which package has it")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES packages)
  set(${uses} "${layers_used}" PARENT_SCOPE)
  set(${needs} "${packages}" PARENT_SCOPE)
endfunction()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/outrider)

# The layers are listed from left to right, so the layers that a layer uses are read before it.
set(components "")
set(component_facts "")
foreach(layer IN LISTS layers)
  get_target_property(name ${layer} EXPORT_NAME)
  outrider_read_links(${layer} uses needs)
  set(layers_of_${name} "")
  set(packages_of_${name} "")
  foreach(used IN LISTS uses)
    list(APPEND layers_of_${name} ${layers_of_${used}})
    list(APPEND packages_of_${name} ${packages_of_${used}})
  endforeach()
  list(APPEND layers_of_${name} ${name})
  list(APPEND packages_of_${name} ${needs})
  list(REMOVE_DUPLICATES layers_of_${name})
  list(REMOVE_DUPLICATES packages_of_${name})
  list(APPEND components ${name})
  string(APPEND component_facts "set(outrider_layers_of_${name} \"${layers_of_${name}}\")\n"
    "set(outrider_packages_of_${name} \"${packages_of_${name}}\")\n")

  install(TARGETS ${layer} EXPORT outrider-${name} COMPONENT dev)
  install(EXPORT outrider-${name} FILE outriderTargets-${name}.cmake NAMESPACE outrider:: DESTINATION ${package_dir}
    COMPONENT dev)
endforeach()

# All layers together, for find_package(outrider) without components.
add_library(outrider_everything INTERFACE)
add_library(outrider::outrider ALIAS outrider_everything)
target_link_libraries(outrider_everything INTERFACE ${layers})
# Within the build this target sees the whole include tree, and so outrider.hpp; layers see only what they
# may.
target_include_directories(outrider_everything INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
set_target_properties(outrider_everything PROPERTIES EXPORT_NAME outrider)
install(TARGETS outrider_everything EXPORT outrider-everything)
install(EXPORT outrider-everything FILE outriderTargets.cmake NAMESPACE outrider:: DESTINATION ${package_dir}
  COMPONENT dev)

file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/outriderComponents.cmake @ONLY CONTENT
  "# The components, from left to right, and of each the layers it links and the packages these need.
set(outrider_components \"@components@\")
@component_facts@")
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/outriderConfig.cmake.in
  ${PROJECT_BINARY_DIR}/outriderConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/outriderConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/outriderConfig.cmake ${PROJECT_BINARY_DIR}/outriderConfigVersion.cmake
  ${PROJECT_BINARY_DIR}/outriderComponents.cmake DESTINATION ${package_dir} COMPONENT dev)
install(DIRECTORY include/outrider DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev FILES_MATCHING PATTERN *.hpp)

include(${CMAKE_CURRENT_LIST_DIR}/PkgConfig.cmake)

# Pages for man and completions for the shells: the tool writes them itself, anew whenever it is built.
set(manual ${PROJECT_BINARY_DIR}/manual)
add_custom_command(OUTPUT ${manual}/outrider.1.gz
  COMMAND outrider manual --out ${manual}
  COMMAND gzip --best --no-name --force ${manual}/*.1
  DEPENDS outrider)
add_custom_target(manual ALL DEPENDS ${manual}/outrider.1.gz)
install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool FILES_MATCHING PATTERN *.1.gz)
install(FILES ${manual}/outrider.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME outrider
  COMPONENT tool)
install(FILES ${manual}/_outrider DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT tool)
install(FILES ${manual}/outrider.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tool)
install(DIRECTORY scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/outrider COMPONENT tool)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT license)  # Debian packages name it in `copyright`
