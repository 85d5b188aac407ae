# Writes what the manual has of every job, its options and the schema of its scenarios:
# cmake -DTOOL=build/outrider -DDOCS=build/docs -P docs.cmake
function(write_page name)
  execute_process(COMMAND ${TOOL} schema ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${DOCS}/${name} "${text}")
endfunction()

execute_process(COMMAND ${TOOL} list --json OUTPUT_VARIABLE catalogue COMMAND_ERROR_IS_FATAL ANY)
string(JSON count LENGTH "${catalogue}" jobs)
math(EXPR last "${count} - 1")
foreach(index RANGE ${last})
  string(JSON job GET "${catalogue}" jobs ${index} name)
  write_page(options-${job}.md --job ${job} --as markdown)
  write_page(${job}.schema.json --job ${job} --as schema)
endforeach()
