# Hardening of releases: an overrun of the stack or of a buffer ends the program instead of being exploited,
# and the tables of function addresses are read-only. docs/reliability.md lists the cost of each measure.
#
# The options apply to our own folders only, so programs that link the library are not affected. Debug and
# sanitizer builds have their own checks.
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
  # Some compilers already define it with another value.
  add_compile_options("$<$<CONFIG:Release>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
endif()

# Also checks indices and iterators of standard containers, in code that reads files and answers requests. In
# the loops of searches this costs more than 2 %.
function(outrider_check_containers target)
  if(OUTRIDER_HARDEN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-D_GLIBCXX_ASSERTIONS>)
  endif()
endfunction()

# Binds all symbols of the tool at startup, before their tables become read-only.
function(outrider_harden_program target)
  if(OUTRIDER_HARDEN)
    target_link_options(${target} PRIVATE "$<$<CONFIG:Release>:LINKER:-z,relro;LINKER:-z,now>")
  endif()
endfunction()
