# A program of at most 15 lines runs the job of a scenario file. It is one of the examples, which ends with a
# comment that holds what it prints.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)
set(example ${SOURCE}/examples/09_run_a_job.cpp)

file(READ ${example} text)
string(FIND "${text}" "// Prints:\n" at)
string(SUBSTRING "${text}" 0 ${at} program)
string(SUBSTRING "${text}" ${at} -1 comment)
string(REGEX REPLACE "\n+" "\n" program "${program}")
string(REGEX MATCHALL "\n" ends "${program}")
list(LENGTH ends lines)
if(lines GREATER 15)
  message(FATAL_ERROR "${example} has ${lines} lines, more than 15")
endif()

configure_project(run_a_job -DPROGRAM=${example})
step("building" ${CMAKE_COMMAND} --build ${TRIAL}/run_a_job)
string(REPLACE "// Prints:\n" "" comment "${comment}")
string(REGEX REPLACE "(^|\n)// ?" "\\1" promised "${comment}")
expect_output(run_a_job/run_a_job "${promised}")
