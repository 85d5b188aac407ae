#include "outrider/io/map/movingai.hpp"

#include <fmt/format.h>

#include <array>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr int longest_octile_side = 100'000;
constexpr std::size_t most_map_cells = 100'000'000;
constexpr std::size_t most_scenarios = 1'000'000;

/// Reads "key N" with N from 1 to the longest side.
Outcome<int> side(TextLines& lines, std::string_view key) {
  lines.next();
  const auto parts = words(lines.line);
  const auto value = parts.size() == 2 && parts[0] == key ? number<int>(parts[1]) : std::nullopt;
  if (!value || *value < 1 || *value > longest_octile_side) {
    return bad_input(fmt::format("'{}' is not valid; this line is '{} N' with N from 1 to {}",
                                 excerpt(lines.line), key, longest_octile_side),
                     lines.where());
  }
  return *value;
}

Status expect_line(TextLines& lines, std::string_view line) {
  lines.next();
  if (words(lines.line) == words(line)) return {};
  return bad_input(fmt::format("'{}' is not valid; this line is '{}'", excerpt(lines.line), line),
                   lines.where());
}

Outcome<GridFrame> header(TextLines& lines) {
  if (auto type = expect_line(lines, "type octile"); !type) return pass_on(type);
  auto height = side(lines, "height");
  if (!height) return pass_on(height);
  auto width = side(lines, "width");
  if (!width) return pass_on(width);
  if (auto map = expect_line(lines, "map"); !map) return pass_on(map);
  const GridFrame frame{{0.0, 0.0}, 1.0, *width, *height};
  if (frame.size() > most_map_cells) {
    return bad_input(fmt::format("{} x {} cells are more than {}, the most that is read", frame.width,
                                 frame.height, most_map_cells),
                     lines.name);
  }
  if (frame.size() > lines.rest.size()) {
    return bad_input(
        fmt::format("it ends before its {} rows of {} letters; it is cut short", frame.height, frame.width),
        lines.name);
  }
  return frame;
}

Outcome<MovingAiQuery> query_of(std::string_view line, const std::string& where) {
  const auto wrong = [&](std::string_view what) {
    return bad_input(fmt::format("'{}' is no query: {}; expected bucket map width height startx starty goalx "
                                 "goaly length",
                                 excerpt(line), what),
                     where);
  };
  const auto parts = words(line);
  if (parts.size() != 9) return wrong(fmt::format("it has {} words", parts.size()));
  std::array<int, 7> numbers{};  // bucket, width, height, start x, y, goal x, y
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto value = number<int>(parts[i == 0 ? 0 : i + 1]);
    if (!value || *value < 0)
      return wrong(fmt::format("'{}' is no count", excerpt(parts[i == 0 ? 0 : i + 1])));
    numbers[i] = *value;
  }
  const auto [bucket, width, height, sx, sy, gx, gy] = numbers;
  if (width < 1 || height < 1 || width > longest_octile_side || height > longest_octile_side)
    return wrong("the size is not 1 to 100000");
  if (sx >= width || gx >= width || sy >= height || gy >= height)
    return wrong("a point lies outside the map");
  const auto length = number<double>(parts[8]);
  if (!length || *length < 0.0) return wrong(fmt::format("'{}' is no length", excerpt(parts[8])));
  return MovingAiQuery{
      bucket, std::string(parts[1]), width, height, {sx, height - 1 - sy}, {gx, height - 1 - gy}, *length};
}

}  // namespace

Outcome<Grid<std::uint8_t>> movingai_map_from_text(std::string_view text, const std::string& name) {
  TextLines lines{text, name};
  auto frame = header(lines);
  if (!frame) return pass_on(frame);
  Grid<std::uint8_t> blocked(*frame);
  for (int row = frame->height - 1; row >= 0; --row) {
    lines.next();
    const std::string_view letters = lines.line;
    if (letters.size() != static_cast<std::size_t>(frame->width)) {
      return bad_input(
          fmt::format("this row has {} letters; the header says {}", letters.size(), frame->width),
          lines.where());
    }
    for (int x = 0; x < frame->width; ++x) {
      const char letter = letters[static_cast<std::size_t>(x)];
      if (std::string_view(".GS@OTW").find(letter) == std::string_view::npos) {
        return bad_input(
            fmt::format("'{}' is no letter of a map; they are . G S (passable) @ O T W (blocked)",
                        excerpt({&letter, 1})),
            lines.where());
      }
      blocked[{x, row}] = std::string_view(".GS").find(letter) == std::string_view::npos ? 1 : 0;
    }
  }
  return blocked;
}

Outcome<std::vector<MovingAiQuery>> movingai_scenario_from_text(std::string_view text,
                                                                const std::string& name) {
  TextLines lines{text, name};
  lines.next();
  const auto version = words(lines.line);
  if (version.size() != 2 || version[0] != "version" || number<double>(version[1]) != 1.0) {
    return bad_input("the first line is not 'version 1'", lines.where());
  }
  std::vector<MovingAiQuery> queries;
  while (lines.next()) {
    if (words(lines.line).empty()) continue;
    if (queries.size() == most_scenarios) {
      return bad_input(fmt::format("more than {} queries; split the file", most_scenarios), lines.where());
    }
    auto query = query_of(lines.line, lines.where());
    if (!query) return pass_on(query);
    queries.push_back(std::move(*query));
  }
  return queries;
}

Outcome<Grid<std::uint8_t>> load_movingai_map(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return movingai_map_from_text(*text, path);
}

Outcome<std::vector<MovingAiQuery>> load_movingai_scenario(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return movingai_scenario_from_text(*text, path);
}

}  // namespace outrider
