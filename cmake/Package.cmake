# Debian packages of what Install.cmake installs, by CPack: `make packages` writes them to build/packages.
#
#   outrider          the tool, with its pages for man, completion for the shells and the scenarios
#   liboutrider-dev   headers, libraries, and what CMake and pkg-config know of them
#   python3-outrider  the Python package, where it is built
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL tool dev)
if(TARGET outrider_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_CONTACT "The Outrider authors <outrider@example.org>")
set(CPACK_PACKAGE_VENDOR "The Outrider authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "path planning and jobs for ground robots")

# Sets `names` to the packages of these groups of packages.txt whose names match.
function(outrider_packages_of names pattern)
  list(JOIN ARGN "|" groups)
  file(STRINGS ${PROJECT_SOURCE_DIR}/packages.txt lines REGEX "^(${groups}) ")
  list(TRANSFORM lines REPLACE "^[^ ]+ +([^ |]+).*" "\\1")
  list(FILTER lines INCLUDE REGEX "${pattern}")
  set(${names} "${lines}" PARENT_SCOPE)
endfunction()

# outrider_debian_package(tool NAME outrider SECTION science TEXT "..." DEPENDS ...)
macro(outrider_debian_package component)
  cmake_parse_arguments(DEB "" "NAME;SECTION;TEXT" "DEPENDS" ${ARGN})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${DEB_NAME})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${DEB_SECTION})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${DEB_TEXT}")
  list(JOIN DEB_DEPENDS ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS)
  install(FILES ${PROJECT_BINARY_DIR}/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${DEB_NAME} COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

outrider_debian_package(tool NAME outrider SECTION science
  TEXT "With outrider a ground robot finds its way, and does a job, in a yard or a
building: it plans paths, pursues a moving target, guards a yard with a water
gun, explores and maps the unknown, covers areas, and localises itself by
landmarks, tags and laser scans. Its web page shows, compares and runs
missions.")
set(CPACK_DEBIAN_TOOL_PACKAGE_SHLIBDEPS ON)

set(used build)
if(OUTRIDER_WITH_PHYSICS AND DART_FOUND)
  list(APPEND used physics)
endif()
outrider_packages_of(libraries "-dev$" ${used})
list(REMOVE_ITEM libraries libcli11-dev libboost-dev nlohmann-json3-dev)  # only our sources include them
outrider_debian_package(dev NAME liboutrider-dev SECTION libdevel
  TEXT "The library of Outrider: planners of paths, pursuits, tours and coverage,
simultaneous localisation and mapping, control, and jobs that robots do.
This package has its headers and static libraries."
  DEPENDS ${libraries})

if(TARGET outrider_python)
  math(EXPR next_minor "${OUTRIDER_PYTHON_MINOR} + 1")
  outrider_debian_package(python NAME python3-outrider SECTION python
    TEXT "The Python module of Outrider: plans, checks and runs missions, and reads their
logs, with arrays of numpy."
    DEPENDS "python3 (>= 3.${OUTRIDER_PYTHON_MINOR})" "python3 (<< 3.${next_minor})" python3-numpy)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # Python compiles a package at its first use; what it wrote goes with the package.
  set(scripts ${PROJECT_BINARY_DIR}/debian/python)
  file(WRITE ${scripts}/postinst "#!/bin/sh\nset -e\nif [ \"$1\" = configure ]; then py3compile -p python3-outrider; fi\n")
  file(WRITE ${scripts}/prerm "#!/bin/sh\nset -e\npy3clean -p python3-outrider\n")
  file(CHMOD ${scripts}/postinst ${scripts}/prerm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${scripts}/postinst ${scripts}/prerm)
endif()

# The licence and the release of every Debian package; the date is that of the newest in CHANGELOG.md.
file(READ ${PROJECT_SOURCE_DIR}/CHANGELOG.md changes)
string(REGEX MATCH "\n## \\[${PROJECT_VERSION}\\] - ([0-9-]+)\n" ignored "${changes}")
set(released ${CMAKE_MATCH_1})
if(NOT released)
  message(FATAL_ERROR "CHANGELOG.md has no release ${PROJECT_VERSION}: write '## [${PROJECT_VERSION}] - YEAR-MONTH-DAY'")
endif()
execute_process(COMMAND date --utc --rfc-email --date ${released} OUTPUT_VARIABLE released OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/debian/changelog @ONLY CONTENT
"outrider (@PROJECT_VERSION@) unstable; urgency=medium

  * Release @PROJECT_VERSION@; CHANGELOG.md of the sources tells what is new.

 -- @CPACK_PACKAGE_CONTACT@  @released@
")
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/debian/copyright @ONLY CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: outrider
Upstream-Contact: @CPACK_PACKAGE_CONTACT@

Files: *
Copyright: 2025-2026 The Outrider authors
License: Apache-2.0
 On Debian systems, the full text of the Apache License, version 2.0, is in
 /usr/share/common-licenses/Apache-2.0.
")
execute_process(COMMAND gzip -9nkf ${PROJECT_BINARY_DIR}/debian/changelog COMMAND_ERROR_IS_FATAL ANY)
include(CPack)
