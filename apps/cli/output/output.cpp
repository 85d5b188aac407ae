#include "output/output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "output/terminal.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/files/files.hpp"
#include "page.hpp"

namespace outrider::cli {

ExitStatus exit_status(const Fault& fault) {
  if (fault.code == FaultCode::cannot_write) return not_written;
  return is_answer(fault) || fault.code == FaultCode::cancelled ? job_not_done : refused;
}

nlohmann::ordered_json fault_json(const Fault& fault) {
  const char* const statuses[] = {"done", "not_done", "refused", "not_written"};
  return {{"status", statuses[exit_status(fault)]},
          {"code", to_string(fault.code)},
          {"reason", fault.sentence},
          {"where", fault.where}};
}

int print_fault(const Fault& fault, bool json) {
  constexpr std::size_t most_where = 255;  // bytes of a path; what is longer is none
  const Fault shown{fault.code, fault.sentence, excerpt(fault.where, most_where)};
  complain(to_string(shown));
  if (json) print(fault_json(shown));
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

Status of_flag_out(Status status) {
  if (!status && status.error().where.empty()) status.error().where = "--out";
  return status;
}

Status write_files(const std::string& folder, const std::vector<NamedText>& files) {
  if (auto ok = make_folder(folder); !ok) return of_flag_out(ok);
  std::vector<NamedContent> placed;
  for (const auto& [name, content] : files) placed.push_back({folder + "/" + name, content});
  std::rotate(placed.begin(), std::min(placed.begin() + 1, placed.end()), placed.end());
  return outrider::write_files(placed);
}

}  // namespace outrider::cli
