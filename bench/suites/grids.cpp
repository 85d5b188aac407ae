#include "grids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include "outrider/io/files/files.hpp"
#include "outrider/io/map/movingai.hpp"

namespace outrider::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 100'000;
constexpr std::size_t most_table_rows = 1'000'000;

/// Returns the path or the path with .gz, whichever is among the files; empty if neither is.
std::string one_of(const std::set<std::string>& files, const std::string& path) {
  if (files.contains(path)) return path;
  return files.contains(path + ".gz") ? path + ".gz" : std::string();
}

std::string any_angle_of(const std::set<std::string>& files, const std::string& name) {
  for (const std::string& file : files) {
    const fs::path path(file);
    if (path.parent_path().filename() != "anyangle") continue;
    if (path.filename() == name + ".csv" || path.filename() == name + ".csv.gz") return file;
  }
  return {};
}

Outcome<std::set<std::string>> files_under(const std::string& folder) {
  std::error_code error;
  std::set<std::string> files;
  fs::recursive_directory_iterator at(folder, error);
  if (error) return bad_input("no folder that can be read; expected one with .map and .scen files", folder);
  for (; at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (error) return bad_input(fmt::format("it cannot be read: {}", error.message()), folder);
    if (at->is_regular_file(error)) files.insert(at->path().string());
    if (files.size() > most_files) {
      return bad_input(fmt::format("it holds more than {} files; name a smaller folder", most_files), folder);
    }
  }
  return files;
}

/// Returns the relative error of published octile lengths, for the sets in which it is known.
double tolerance_of(const std::string& set) {
  if (set == "bg512") return 2e-3;
  if (set == "wc3maps512") return std::numeric_limits<double>::infinity();
  return 1e-5;
}

Outcome<std::array<double, 6>> table_row(std::string_view line, const std::string& where) {
  std::array<double, 6> values{};
  const char* at = line.data();
  const char* end = line.data() + line.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [next, error] = std::from_chars(at, end, values[i]);
    const bool ended = i + 1 == values.size() ? next == end : next != end && *next == ',';
    if (error != std::errc() || !ended || values[i] < 0.0 || values[i] > 1e9 || std::isnan(values[i])) {
      return bad_input("no row of the table; expected sx,sy,gx,gy,octile_cells,anyangle_opt", where);
    }
    at = next == end ? end : next + 1;
  }
  return values;
}

Outcome<std::vector<GridQueryRow>> any_angle_rows(const std::string& file, const GridFrame& frame) {
  auto text = read_file(file);
  if (!text) return pass_on(text);
  std::vector<GridQueryRow> rows;
  std::string_view rest = *text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (number == 1 || line.empty()) continue;
    const std::string where = fmt::format("{}:{}", file, number);
    auto row = table_row(line, where);
    if (!row) return pass_on(row);
    const auto [sx, sy, gx, gy, octile, shortest] = *row;
    const auto cell = [&](double x, double y) {
      return Cell{static_cast<int>(x), frame.height - 1 - static_cast<int>(y)};
    };
    rows.push_back({cell(sx, sy), cell(gx, gy), octile, shortest});
    if (!frame.contains(rows.back().start) || !frame.contains(rows.back().goal)) {
      return bad_input(
          fmt::format("a point lies outside the map of {} x {} cells", frame.width, frame.height), where);
    }
    if (rows.size() > most_table_rows) return bad_input("it has more than a million rows", file);
  }
  return rows;
}

Outcome<std::vector<GridQueryRow>> scenario_rows(const std::string& file, const GridFrame& frame) {
  auto queries = load_movingai_scenario(file);
  if (!queries) return pass_on(queries);
  std::vector<GridQueryRow> rows;
  for (const MovingAiQuery& query : *queries) {
    if (query.width != frame.width || query.height != frame.height) {
      return bad_input(fmt::format("a query is for a map of {} x {} cells; the map has {} x {}", query.width,
                                   query.height, frame.width, frame.height),
                       file);
    }
    rows.push_back({query.start, query.goal, query.octile_length, std::nullopt});
  }
  return rows;
}

}  // namespace

Outcome<std::vector<GridFiles>> find_grids(const std::string& folder) {
  auto files = files_under(folder);
  if (!files) return pass_on(files);
  std::vector<GridFiles> grids;
  for (const std::string& file : *files) {
    const std::string stem = file.ends_with(".gz") ? file.substr(0, file.size() - 3) : file;
    if (!stem.ends_with(".map")) continue;
    const fs::path path(stem);
    GridFiles grid{path.stem().string(), path.parent_path().filename().string(), file,
                   one_of(*files, stem + ".scen"), any_angle_of(*files, path.stem().string())};
    if (!grid.scenario.empty() || !grid.any_angle.empty()) grids.push_back(std::move(grid));
  }
  if (grids.empty()) return bad_input("it holds no .map with a .map.scen beside it", folder);
  return grids;
}

Outcome<PublishedGrid> load_grid(const GridFiles& files, std::size_t most_rows, bool all_rows) {
  PublishedGrid grid;
  auto blocked = load_movingai_map(files.map);
  if (!blocked) return pass_on(blocked);
  grid.blocked = std::move(*blocked);
  grid.octile_tolerance = tolerance_of(files.set);
  const bool from_scenario = files.any_angle.empty() || (all_rows && !files.scenario.empty());
  auto rows = from_scenario ? scenario_rows(files.scenario, grid.blocked.frame)
                            : any_angle_rows(files.any_angle, grid.blocked.frame);
  if (!rows) return pass_on(rows);
  const std::size_t count = std::min(most_rows, rows->size());
  for (std::size_t i = 1; i <= count; ++i) grid.rows.push_back((*rows)[i * rows->size() / count - 1]);
  return grid;
}

}  // namespace outrider::bench
