# cmake -DBUILD= -DPROJECT= -DTRIAL= -DCOMPILER= -DFLAGS= -P trial.cmake
file(REMOVE_RECURSE ${TRIAL})

function(step what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

step("installing" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${TRIAL}/prefix)
# How we compile our own files is nothing that who links them gets.
file(GLOB_RECURSE exported ${TRIAL}/prefix/outriderTargets*.cmake)
if(NOT exported)
  message(FATAL_ERROR "the package has no outriderTargets.cmake")
endif()
foreach(file IN LISTS exported)
  file(STRINGS ${file} ours REGEX "fstack-|FORTIFY_SOURCE|GLIBCXX_ASSERTIONS|fcf-|relro")
  if(ours)
    message(FATAL_ERROR "the package tells its users to compile with ${ours} (${file})")
  endif()
endforeach()
step("configuring" ${CMAKE_COMMAND} -G Ninja -S ${PROJECT} -B ${TRIAL}/build -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_PREFIX_PATH=${TRIAL}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS})
step("building" ${CMAKE_COMMAND} --build ${TRIAL}/build)
step("running" ${TRIAL}/build/clearance)

file(READ ${PROJECT}/expected_output.txt expected)
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "the project printed\n${output}instead of\n${expected}")
endif()
