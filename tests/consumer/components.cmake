# Asks for components that do not exist or lack a package, and checks what is found and what is said.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
configure_project(components)
