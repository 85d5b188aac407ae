#include <initializer_list>

#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "page.hpp"
#include "text.hpp"

namespace outrider {
namespace {

// JSON for a script element: '<' stands only inside strings there, and as an escape it can neither
// close the element nor open a comment.
std::string script_data(const std::string& json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

struct Part {
  std::string_view marker;
  std::string text;
};

// Each marker stands once in the page, in this order; what is put in is not searched again.
std::string filled(std::string_view page, std::initializer_list<Part> parts) {
  std::string text;
  for (const Part& part : parts) {
    const std::size_t at = page.find(part.marker);
    text += page.substr(0, at);
    text += part.text;
    page.remove_prefix(at + part.marker.size());
  }
  text += page;
  return text;
}

}  // namespace

std::string to_html(const Report& report) {
  const auto page_of = [&](std::string_view page, const std::string& script) {
    return filled(page, {{"@TITLE@", markup_text(report.job + ": " + report.world_name)},
                         {"@STYLE@", std::string(page::replay_css)},
                         {"@REPORT@", script_data(to_json(report))},
                         {"@SCRIPT@", script}});
  };
  if (report.chase) return page_of(page::chase_html, std::string(page::chase_js));
  if (report.explore && report.shots.empty()) {
    return page_of(page::explore_html, std::string(page::discovery_js) + std::string(page::explore_js));
  }
  std::string script;
  for (const std::string_view part :
       {page::model_js, page::camera_js, page::discovery_js, page::plan_js, page::side_js, page::levels_js,
        page::table_js, page::transport_js, page::replay_js}) {
    script += part;
  }
  return page_of(page::replay_html, script);
}

std::string to_html(const Report& report, std::string_view viewer) {
  if (viewer.empty()) return to_html(report);
  return filled(viewer, {{"@TITLE@", markup_text(report.job + ": " + report.world_name)},
                         {"@REPORT@", script_data(to_json(report))}});
}

}  // namespace outrider
