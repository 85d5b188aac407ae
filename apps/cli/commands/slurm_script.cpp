#include "commands/slurm_script.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace outrider::cli {
namespace {

constexpr std::uint64_t most_tasks = 1000;

/// Returns the word as a shell reads it.
std::string quoted(const std::string& word) {
  constexpr auto plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./=,:+";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

std::string slurm_script(const std::vector<std::string>& words, const std::string& working_folder,
                         const std::string& folder, std::uint64_t chunks) {
  const std::uint64_t each = (chunks + most_tasks - 1) / most_tasks;
  const std::uint64_t tasks = (chunks + each - 1) / each;
  std::string command;
  for (const std::string& word : words) command += quoted(word) + " ";
  return fmt::format(
      "#!/bin/sh\n"
      "#SBATCH --job-name=outrider-sweep\n"
      "#SBATCH --array=0-{}\n"
      "#SBATCH --output={}/slurm-%a.txt\n"
      "# Submit it with sbatch, with --cpus-per-task=N for N threads. When all tasks have ended:\n"
      "#   outrider sweep {} --merge\n"
      "# A task that failed or was killed is submitted again with sbatch --array=NUMBER.\n"
      "cd {} || exit 2\n"
      "first=$((SLURM_ARRAY_TASK_ID * {}))\n"
      "last=$((first + {}))\n"
      "[ $last -lt {} ] || last={}\n"
      "exec {}--threads \"${{SLURM_CPUS_PER_TASK:-1}}\" --chunks $first..$last\n",
      tasks - 1, folder, quoted(folder), quoted(working_folder), each, each - 1, chunks, chunks - 1, command);
}

}  // namespace outrider::cli
