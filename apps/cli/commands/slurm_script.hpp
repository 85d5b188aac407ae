// The script of a Slurm job array that computes the chunks of a sweep.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace outrider::cli {

/// Returns a script for sbatch. Its tasks, at most 1,000, which clusters take unless they are told otherwise,
/// share the chunks; each runs `words` with the flag --chunks. `folder` receives what they print.
std::string slurm_script(const std::vector<std::string>& words, const std::string& working_folder,
                         const std::string& folder, std::uint64_t chunks);

}  // namespace outrider::cli
