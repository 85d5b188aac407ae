# What `cmake --install` leaves: the headers, one static library a layer, the tool, and a package that
# find_package(outrider) finds. A stranger links outrider::outrider, or just the layers they want
# (outrider::path); tests/consumer does so.
include(CMakePackageConfigHelpers)

get_property(layers GLOBAL PROPERTY OUTRIDER_LAYERS)

add_library(outrider_everything INTERFACE)
add_library(outrider::outrider ALIAS outrider_everything)
target_link_libraries(outrider_everything INTERFACE ${layers})
# Within the build it sees the whole tree, and so outrider.hpp; layers see only what they may.
target_include_directories(outrider_everything INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
set_target_properties(outrider_everything PROPERTIES EXPORT_NAME outrider)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/outrider)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/outriderConfig.cmake.in
  ${PROJECT_BINARY_DIR}/outriderConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/outriderConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)

install(TARGETS outrider_everything ${layers} EXPORT outriderTargets)
install(EXPORT outriderTargets NAMESPACE outrider:: DESTINATION ${package_dir})
install(FILES ${PROJECT_BINARY_DIR}/outriderConfig.cmake ${PROJECT_BINARY_DIR}/outriderConfigVersion.cmake
  DESTINATION ${package_dir})
install(DIRECTORY include/outrider DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.hpp)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
