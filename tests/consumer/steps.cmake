# Steps that the scripts of this folder share.
cmake_minimum_required(VERSION 3.25)
set(here ${CMAKE_CURRENT_LIST_DIR})

# Runs a command and leaves what it printed in `output`; the test fails if the command does.
function(step what)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE status
    OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Configures a project of this folder in a fresh folder, ${TRIAL}/NAME, against the installed package.
function(configure_project name)
  file(REMOVE_RECURSE ${TRIAL}/${name})
  step("configuring" ${CMAKE_COMMAND} -G Ninja -S ${here}/${name} -B ${TRIAL}/${name} --no-warn-unused-cli
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${TRIAL}/prefix -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCMAKE_CXX_FLAGS=${FLAGS} ${ARGN})
endfunction()

# Runs a program of a project and compares what it prints.
function(expect_output program expected)
  step("running" ${TRIAL}/${program})
  if(NOT output STREQUAL expected)
    message(FATAL_ERROR "the program printed\n${output}instead of\n${expected}")
  endif()
endfunction()
