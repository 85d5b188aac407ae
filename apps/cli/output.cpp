#include "output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "outrider/io/files.hpp"
#include "page.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Fault> no_folder(const std::string& folder, const std::string& reason) {
  return bad_input(
      fmt::format("cannot make the folder '{}' ({}); name one that can be written to", folder, reason),
      "--out");
}

}  // namespace

bool is_answer(const Fault& fault) {
  return fault.code == FaultCode::no_path || fault.code == FaultCode::no_shot ||
         fault.code == FaultCode::budget_exhausted || fault.code == FaultCode::cancelled;
}

ExitStatus exit_status(const Fault& fault) {
  if (fault.code == FaultCode::cannot_write) return not_written;
  return is_answer(fault) ? job_not_done : refused;
}

nlohmann::ordered_json fault_json(const Fault& fault) {
  const char* const statuses[] = {"done", "not_done", "refused", "not_written"};
  return {{"status", statuses[exit_status(fault)]},
          {"code", to_string(fault.code)},
          {"reason", fault.sentence},
          {"where", fault.where}};
}

int print_fault(const Fault& fault, bool json) {
  complain(to_string(fault));
  if (json) print(fault_json(fault));
  return exit_status(fault);
}

Status check_page(std::string flag) {
  if (page::viewer().empty()) return bad_input(std::string(page::missing), std::move(flag));
  return {};
}

std::string json_text(const nlohmann::ordered_json& object, int indent) {
  return object.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void print(const nlohmann::ordered_json& object) { show_text(json_text(object) + "\n"); }

Status check_folder(const std::string& folder) {
  if (folder.empty()) return no_folder(folder, "its name is empty");
  std::error_code error;
  fs::path nearest = fs::absolute(folder, error);  // the nearest parent that exists
  while (!error && !fs::exists(fs::symlink_status(nearest)) && nearest.has_relative_path()) {
    nearest = nearest.parent_path();
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
  if (!fs::is_directory(folder)) return no_folder(folder, error.message());
  return {};
}

Status write_files(const std::string& folder, const std::vector<NamedText>& files) {
  if (auto ok = make_folder(folder); !ok) return ok;
  std::vector<NamedContent> placed;
  for (const auto& [name, content] : files) placed.push_back({folder + "/" + name, content});
  std::rotate(placed.begin(), std::min(placed.begin() + 1, placed.end()), placed.end());
  return outrider::write_files(placed);
}

}  // namespace outrider::cli
