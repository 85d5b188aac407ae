#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "outrider/core/text.hpp"
#include "outrider/io/files.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_path = 200;  ///< bytes of a path that is shown

tl::unexpected<Fault> no_folder(const std::string& folder, const std::string& reason) {
  return bad_input(fmt::format("cannot make the folder '{}' ({}); name one that can be written to",
                               excerpt(folder, most_path), excerpt(reason, most_path)));
}

}  // namespace

Status check_folder(const std::string& folder) {
  if (folder.empty()) return no_folder(folder, "its name is empty");
  std::error_code error;
  fs::path nearest = fs::absolute(folder, error);  // the nearest parent that exists
  for (std::error_code why; !error && nearest.has_relative_path(); nearest = nearest.parent_path()) {
    if (fs::exists(fs::symlink_status(nearest, why))) break;
    if (why == std::errc::filename_too_long) return no_folder(folder, why.message());
  }
  if (error) return no_folder(folder, error.message());
  if (!fs::is_directory(nearest, error)) return no_folder(folder, nearest.string() + " is no folder");
  if (::access(nearest.c_str(), W_OK | X_OK) != 0) {
    return no_folder(folder, "nothing may be written to " + nearest.string());
  }
  return {};
}

Status make_folder(const std::string& folder) {
  if (auto ok = check_folder(folder); !ok) return ok;
  std::error_code error;
  fs::create_directories(folder, error);
  if (std::error_code ignored; !fs::is_directory(folder, ignored)) return no_folder(folder, error.message());
  return {};
}

}  // namespace outrider
