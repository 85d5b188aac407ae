# Writes the generated pages of the manual: cmake -DTOOL=build/outrider -DDOCS=docs -P docs.cmake
function(write_page job form name)
  execute_process(COMMAND ${TOOL} schema --job ${job} --as ${form} OUTPUT_VARIABLE text
    COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${DOCS}/${name} "${text}")
  message(STATUS "wrote ${DOCS}/${name}")
endfunction()

write_page(guard markdown options.md)
write_page(guard schema scenario.schema.json)
write_page(pursue markdown options-pursue.md)
write_page(cover markdown options-cover.md)
write_page(drive markdown options-drive.md)
write_page(explore markdown options-explore.md)
write_page(fleet markdown options-fleet.md)
write_page(plan markdown options-plan.md)
write_page(slam markdown options-slam.md)
