# All of Outrider: a project that asks for no components.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
configure_project(clearance)
step("building" ${CMAKE_COMMAND} --build ${TRIAL}/clearance)
file(READ ${here}/clearance/expected_output.txt expected)
expect_output(clearance/clearance "${expected}")
