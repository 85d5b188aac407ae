#include "outrider/io/pyfg.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

#include "graph_lines.hpp"

namespace outrider {
namespace {

struct PyfgForm {
  std::string_view tag;
  std::size_t names_from;  ///< index of the word with the first name
  std::size_t names;
  std::size_t numbers;
  std::string_view sentence;
};
constexpr std::array<PyfgForm, 5> pyfg_forms = {{
    {"VERTEX_SE2", 2, 1, 3, "VERTEX_SE2 time name x y heading"},
    {"VERTEX_XY", 1, 1, 2, "VERTEX_XY name x y"},
    {"EDGE_SE2", 2, 2, 9, "EDGE_SE2 time from to x y heading and 6 numbers of the covariance"},
    {"EDGE_SE2_XY", 2, 2, 5, "EDGE_SE2_XY time from to x y and 3 numbers of the covariance"},
    {"EDGE_RANGE", 2, 2, 2, "EDGE_RANGE time from to range and its variance"},
}};

struct PyfgReader {
  GraphLines<Pose2> lines;
  std::vector<Pose2> truth;
  std::set<char> robots;  ///< robots whose first pose was read

  Status vertex(std::string_view name, const Pose2& pose, bool is_point) {
    if (auto ok = lines.place(name, pose, is_point); !ok) return ok;
    truth.push_back(pose);
    lines.placed.back() = !is_point && robots.insert(name.front()).second;
    return {};
  }

  Status line(std::string_view text) {
    const std::vector<std::string_view> all = words(text);
    const PyfgForm* form = nullptr;
    for (const PyfgForm& candidate : pyfg_forms) {
      if (candidate.tag == all[0]) form = &candidate;
    }
    if (form == nullptr) {
      return bad_input(
          fmt::format("'{}' is no line of a graph of the plane; expected VERTEX_SE2, VERTEX_XY, "
                      "EDGE_SE2, EDGE_SE2_XY or EDGE_RANGE",
                      excerpt(all[0])));
    }
    const std::size_t numbers_from = form->names_from + form->names;
    const std::span<const std::string_view> span(all);
    const auto values =
        all.size() == numbers_from + form->numbers ? numbers_of(span.subspan(numbers_from)) : std::nullopt;
    if (!values)
      return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(text), form->sentence));
    const auto& v = *values;
    const std::span<const double> numbers(v);
    const std::string_view name = all[form->names_from];
    if (form->tag == "VERTEX_SE2") return vertex(name, {{v[0], v[1]}, v[2]}, false);
    if (form->tag == "VERTEX_XY") return vertex(name, {{v[0], v[1]}, 0.0}, true);
    const std::string_view to = all[form->names_from + 1];
    for (const std::string_view end : {name, to}) {
      if (!lines.knows(end))
        return bad_input(fmt::format("there is no vertex {}; put its line before", excerpt(end)));
    }
    if (form->tag == "EDGE_SE2") {
      return lines.join(EdgeKind::pose, name, to, {{v[0], v[1]}, v[2]}, numbers.subspan(3),
                        EdgeMatrix::covariance);
    }
    if (form->tag == "EDGE_SE2_XY") {
      return lines.join(EdgeKind::point, name, to, {{v[0], v[1]}, 0.0}, numbers.subspan(2),
                        EdgeMatrix::covariance);
    }
    return lines.join(EdgeKind::range, name, to, {{v[0], 0.0}, 0.0}, numbers.subspan(1),
                      EdgeMatrix::covariance);
  }
};

}  // namespace

Outcome<TrueGraph> pose_graph_from_pyfg(std::string_view text, const std::string& name) {
  PyfgReader reader;
  auto read = read_graph_lines(text, name, [&](std::string_view line) { return reader.line(line); });
  if (!read) return pass_on(read);
  auto graph = std::move(reader.lines).finish();
  if (!graph) return bad_input(graph.error().sentence, name);
  return TrueGraph{std::move(*graph), std::move(reader.truth)};
}

}  // namespace outrider
