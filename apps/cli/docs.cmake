# Writes the generated pages of the manual: cmake -DTOOL=build/outrider -DDOCS=docs -P docs.cmake
function(write_page form name)
  execute_process(COMMAND ${TOOL} schema --as ${form} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${DOCS}/${name} "${text}")
  message(STATUS "wrote ${DOCS}/${name}")
endfunction()

write_page(markdown options.md)
write_page(schema scenario.schema.json)
