#include "commands/research.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

namespace outrider::cli {

Fault become_research(const std::vector<std::string>& words) {
  std::error_code ignored;
  const auto program =
      std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / "outrider-research";
  std::vector<char*> arguments = {const_cast<char*>(program.c_str())};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  return {FaultCode::bad_input, fmt::format("{} is not there; 'make research' builds it", program.string()),
          "research"};
}

}  // namespace outrider::cli
