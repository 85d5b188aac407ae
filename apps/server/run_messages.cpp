#include "run_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace outrider::server {
namespace {

constexpr std::size_t events_at_once = 200;
constexpr std::size_t rows_at_once = 500;
constexpr std::array columns = {"time_s", "x", "y", "heading_rad", "gun_yaw_rad", "gun_pitch_rad"};

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

/// Splits a list into parts of at most `size`; returns none if the value is not a list.
std::vector<Json> parts_of(const Json& list, std::size_t size) {
  std::vector<Json> parts;
  if (!list.is_array()) return parts;
  for (std::size_t begin = 0; begin < list.size(); begin += size) {
    const auto first = list.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = list.begin() + static_cast<std::ptrdiff_t>(std::min(list.size(), begin + size));
    parts.push_back(Json(Json::array_t(first, last)));
  }
  return parts;
}

/// Returns true if the value is a list with an item that is not an empty list.
bool has_items(const Json& value) {
  return value.is_array() && std::any_of(value.begin(), value.end(),
                                         [](const Json& item) { return !item.is_array() || !item.empty(); });
}

/// Returns the non-empty lists of a report, at their places in it.
Json growth_of(const Json& report) {
  Json growth = Json::object();
  for (const auto& [key, value] : report.items()) {
    if (has_items(value)) growth[key] = value;
    if (key == "world" || key == "robot" || !value.is_object()) continue;
    for (const auto& [name, list] : value.items()) {
      if (has_items(list)) growth[key][name] = list;
    }
  }
  return growth;
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

std::optional<Json> omitted_of(const Json& line) {
  if (!line.is_object() || !line.contains("omitted")) return std::nullopt;
  Fields fields(line, "");
  const std::string what = fields.text("omitted");
  const auto bytes = fields.integer("bytes", 0, 1'000'000'000'000);
  const auto most = fields.integer("most_bytes", 1, 1'000'000'000'000);
  if (!fields.end() || (what != "scene" && what != "news")) return std::nullopt;
  const auto mib = [](std::int64_t n) { return static_cast<double>(n) / (1 << 20U); };
  return Json{{"type", "omitted"},
              {"what", what},
              {"sentence", fmt::format("{} takes {:.1f} MiB, and at most {:.1f} MiB are told while a mission "
                                       "runs; the report has it in the end",
                                       what == "scene" ? "what stands still here" : "a part of what happened",
                                       mib(bytes), mib(most))}};
}

std::vector<Json> messages_of(Json line) {
  std::vector<Json> messages;
  if (!line.is_object() || !line.contains("outrider_report")) return messages;
  const Json events = std::exchange(line["events"], Json::array());
  const Json track = std::exchange(line["track"], Json::array());
  Json map;
  for (const char* part : {"explore", "slam"}) {
    if (!line.contains(part) || !line[part].contains("map")) continue;
    map = std::move(line[part]["map"]);
    line[part].erase("map");
  }
  if (line.value("job", "") != "") {
    messages.push_back({{"type", "scene"}, {"report", std::move(line)}});
  } else if (Json growth = growth_of(line); !growth.empty()) {
    messages.push_back({{"type", "growth"}, {"report", std::move(growth)}});
  }
  if (map.is_object() && map.value("columns", 0) > 0)
    messages.push_back({{"type", "map"}, {"map", std::move(map)}});
  for (Json& part : parts_of(track, rows_at_once)) {
    messages.push_back({{"type", "samples"}, {"columns", columns}, {"rows", std::move(part)}});
  }
  for (Json& part : parts_of(events, events_at_once)) {
    messages.push_back({{"type", "events"}, {"events", std::move(part)}});
  }
  return messages;
}

Conclusion conclusion_of(const ChildResult& child) {
  if (child.cancelled) return {"cancelled", {FaultCode::cancelled, "the mission was cancelled", {}}, {}};
  if (child.timed_out) {
    return {
        "failed", {FaultCode::budget_exhausted, "the mission took longer than the server allows", {}}, {}};
  }
  Json summary = Json::parse(child.output, nullptr, false);
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

Fault plain_fault(Fault fault, const std::filesystem::path& root, const std::string& unsaved) {
  for (std::string* text : {&fault.sentence, &fault.where}) {
    replace_all(*text, root.string() + "/", "");
    if (!unsaved.empty()) replace_all(*text, unsaved, "scenario");
  }
  return fault;
}

}  // namespace outrider::server
