#include "runs/run_messages.hpp"

namespace outrider::server {
namespace {

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
}

/// Returns the last line that a program printed.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t newline = text.rfind('\n');
  if (newline != std::string::npos) text.erase(0, newline + 1);
  return text.substr(0, 500);
}

}  // namespace

std::optional<Json> progress_of(const Json& line) {
  if (!line.is_object() || !line.contains("step")) return std::nullopt;
  Fields fields(line, "");
  Json progress = {{"step", fields.integer("step", 0, 1000)},
                   {"steps", fields.integer("steps", 1, 1000)},
                   {"name", fields.text("name")},
                   {"part", fields.number("part", 0.0, 1.0)}};
  return fields.end() ? std::optional(std::move(progress)) : std::nullopt;
}

Conclusion conclusion_of(const ChildResult& child) {
  if (child.cancelled) return {"cancelled", {FaultCode::cancelled, "the mission was cancelled", {}}, {}};
  if (child.timed_out) {
    return {"failed",
            {FaultCode::budget_exhausted, "the mission took more processor time than the server allows", {}},
            {}};
  }
  std::string output = child.output;
  replace_all(output, std::string(child_out) + "/", "");  // it knows its folder by that name only
  replace_all(output, std::string(child_out), "its folder");
  Json summary = Json::parse(output, nullptr, false);
  const char* const states[] = {"done", "not_done", "refused", "failed"};
  if (child.status < 0 || child.status > 3 || !summary.is_object()) {
    const std::string said = last_line(child.errors);
    return {"failed",
            {FaultCode::bad_input,
             "the mission ended before it had an answer" + (said.empty() ? "" : ": " + said),
             {}},
            {}};
  }
  Conclusion conclusion{states[child.status], {FaultCode::bad_input, {}, {}}, {}};
  conclusion.fault.sentence = child.status == 0 ? "" : summary.value("reason", "");
  conclusion.fault.where = child.status == 0 ? "" : summary.value("where", "");
  if (child.status < 2) conclusion.summary = std::move(summary);
  return conclusion;
}

Fault plain_fault(Fault fault, const std::string& unsaved) {
  for (std::string* text : {&fault.sentence, &fault.where}) {
    if (!unsaved.empty()) replace_all(*text, unsaved, "scenario");
  }
  return fault;
}

}  // namespace outrider::server
