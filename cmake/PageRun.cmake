# Builds the page: MODE (AUTO or ON), WEB (its sources), OUT (a folder), SOURCE (the C++ file to write).
find_program(NPM npm)
find_program(NODE node)

function(run result)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WEB} RESULT_VARIABLE status
    OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    message(NOTICE "${text}")
  endif()
  set(${result} ${status} PARENT_SCOPE)
endfunction()

# npm keeps a list of the installed packages; it is older than the lock file if that has changed. While the
# list is missing, Ninja runs this script again, so a tool without the page gets it as soon as it can be
# built.
set(installed ${WEB}/node_modules/.package-lock.json)
file(WRITE ${SOURCE}.d "${SOURCE}: ${installed}\n")
set(missing "")
if(NOT NPM OR NOT NODE)
  set(missing "npm is not installed")
elseif(NOT EXISTS ${installed} OR ${WEB}/package-lock.json IS_NEWER_THAN ${installed})
  run(status ${NPM} ci --no-audit --no-fund --ignore-scripts --prefer-offline --fetch-retries 1
    --fetch-retry-mintimeout 1000 --fetch-timeout 60000)
  if(status EQUAL 0)
    file(TOUCH ${installed})
  else()
    set(missing "npm could not get the packages of the page from its registry (its message is above)")
  endif()
endif()
if(missing AND MODE STREQUAL "AUTO")
  message(NOTICE "${missing}, so the tool has no page this time")
  configure_file(${WEB}/../apps/page/no_page.cpp ${SOURCE} COPYONLY)
  return()
elseif(missing)
  message(FATAL_ERROR "${missing}")
endif()

run(status ${NODE} ${WEB}/build/pages.mjs ${OUT})
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the page could not be built")
endif()
run(status ${NODE} ${WEB}/build/embed.mjs ${OUT} ${SOURCE})
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the page could not be put into ${SOURCE}")
endif()
