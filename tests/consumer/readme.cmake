# cmake -DREADME= -DPROJECT= -P readme.cmake
file(READ ${README} readme)
foreach(name CMakeLists.txt main.cpp)
  file(READ ${PROJECT}/${name} text)
  string(FIND "${readme}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "README.md does not hold tests/consumer/project/${name} word for word")
  endif()
endforeach()
