# How a release is hardened: an overrun of the stack or of a buffer ends the program instead of being put to use,
# and the tables that calls go through cannot be written to. docs/reliability.md has what each costs.
#
# Options of our own folders, so nothing of it reaches who links the library. Debug builds and those of the
# sanitizers have checks of their own.
option(OUTRIDER_HARDEN "Compile releases with checks of stack, buffers and jumps" ON)

if(OUTRIDER_HARDEN)
  include(CheckCXXCompilerFlag)
  foreach(flag stack-protector-strong stack-clash-protection cf-protection)
    string(MAKE_C_IDENTIFIER "OUTRIDER_HAS_${flag}" has)
    check_cxx_compiler_flag(-f${flag} ${has})
    if(${has})
      add_compile_options($<$<CONFIG:Release>:-f${flag}>)
    endif()
  endforeach()
  # Some compilers define it already, as another number.
  add_compile_options("$<$<CONFIG:Release>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
endif()

# Checks the indices and iterators of standard containers too: for what reads files and answers requests. In the
# loops of searches it costs more than 2 %.
function(outrider_check_containers target)
  if(OUTRIDER_HARDEN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-D_GLIBCXX_ASSERTIONS>)
  endif()
endfunction()

# The tool: all of its symbols are bound as it starts, before the tables of them become read-only.
function(outrider_harden_program target)
  if(OUTRIDER_HARDEN)
    target_link_options(${target} PRIVATE "$<$<CONFIG:Release>:LINKER:-z,relro;LINKER:-z,now>")
  endif()
endfunction()
