// Scripts with which a shell completes the commands and flags of the tool.
#pragma once

#include <string>

#include "command.hpp"

namespace outrider::cli {

/// Returns a script for bash, to be sourced or put into bash-completion's folder. Completes commands, flags,
/// and the names of files elsewhere.
std::string bash_completion(const CommandText& tool);
/// Returns a function file `_outrider` for a folder of zsh's `fpath`. It shows the sentence of each flag.
std::string zsh_completion(const CommandText& tool);
/// Returns a script for fish's folder of completions. It shows the sentence of each flag.
std::string fish_completion(const CommandText& tool);

}  // namespace outrider::cli
