# What is found, and what is said, when components are asked for that do not exist or lack a package.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
configure_project(components)
