# The page: npm builds web/ into ${PROJECT_BINARY_DIR}/web, and apps/page compiles the result into the tool.
#
# AUTO builds the page if npm is installed and can get its packages. Otherwise the tool is built without the
# page, the build says so, and the next build tries again. Sets OUTRIDER_PAGE_SOURCE to the C++ source that
# holds the page or its absence; with OFF it is empty.
set(OUTRIDER_WITH_PAGE AUTO CACHE STRING "The web page: AUTO (where npm is found), ON or OFF")

set(OUTRIDER_PAGE_SOURCE "")
if(OUTRIDER_WITH_PAGE)
  set(OUTRIDER_PAGE_SOURCE ${PROJECT_BINARY_DIR}/web/page_files.cpp)
  file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/src/* ${PROJECT_SOURCE_DIR}/web/build/*)
  add_custom_command(OUTPUT ${OUTRIDER_PAGE_SOURCE}
    COMMAND ${CMAKE_COMMAND} -DMODE=${OUTRIDER_WITH_PAGE} -DWEB=${PROJECT_SOURCE_DIR}/web
      -DOUT=${PROJECT_BINARY_DIR}/web -DSOURCE=${OUTRIDER_PAGE_SOURCE} -P ${PROJECT_SOURCE_DIR}/cmake/PageRun.cmake
    DEPENDS ${page_sources} ${PROJECT_SOURCE_DIR}/web/index.html ${PROJECT_SOURCE_DIR}/web/viewer.html
      ${PROJECT_SOURCE_DIR}/web/vite.config.ts ${PROJECT_SOURCE_DIR}/web/package-lock.json
      ${PROJECT_SOURCE_DIR}/cmake/PageRun.cmake ${PROJECT_SOURCE_DIR}/apps/page/no_page.cpp
    DEPFILE ${OUTRIDER_PAGE_SOURCE}.d COMMENT "Building the page" VERBATIM)
endif()
