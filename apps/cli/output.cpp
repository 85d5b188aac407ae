#include "output.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace outrider::cli {

int say(const Fault& fault, const Output& output) {
  fmt::print(stderr, "outrider: {}\n", to_string(fault));
  const bool answered = fault.code == FaultCode::no_path || fault.code == FaultCode::no_shot ||
                        fault.code == FaultCode::budget_exhausted || fault.code == FaultCode::cancelled;
  if (output.json) {
    print({{"status", answered ? "not_done" : "refused"},
           {"code", to_string(fault.code)},
           {"reason", fault.sentence},
           {"where", fault.where}});
  }
  return answered ? job_not_done : refused;
}

void print(const nlohmann::ordered_json& object) {
  // Names from files may hold any bytes: what is no UTF-8 is replaced, never thrown at the user.
  fmt::print("{}\n", object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

Status make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    return bad_input(fmt::format("cannot make the folder '{}' ({}); name one that can be written to", folder,
                                 error ? error.message() : "a file is in its place"),
                     "--out");
  }
  return {};
}

std::string duration_text(double seconds) {
  if (seconds < 1.0) return fmt::format("{:.2f} s", seconds);
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long>(seconds + 0.5);
  return fmt::format("{} min {} s", whole / 60, whole % 60);
}

}  // namespace outrider::cli
