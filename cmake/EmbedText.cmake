# Makes a C++ source that holds a text file: outrider_embed_text(OUT FILE NAMESPACE NAME) defines
#   namespace outrider::NAMESPACE { extern const std::string_view NAME; }
function(outrider_embed_text out file space name)
  set(script ${PROJECT_SOURCE_DIR}/cmake/EmbedTextRun.cmake)
  add_custom_command(OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DIN=${file} -DOUT=${out} -DSPACE=${space} -DNAME=${name} -P ${script}
    DEPENDS ${file} ${script} VERBATIM)
endfunction()
