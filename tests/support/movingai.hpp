// The published MovingAI grids, for tests: plain or gzip-compressed, in the folder that the
// environment variable OUTRIDER_DATA names.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/world/grid.hpp"
#include "support/costly_cases.hpp"

namespace outrider::movingai {

/// A query of a .scen file, or of an any-angle table; rows are counted from the top.
struct Query {
  Cell start, goal;
  double length = 0.0;
};

inline std::filesystem::path data_folder() {
  if (const char* folder = std::getenv("OUTRIDER_DATA"); folder != nullptr && *folder != '\0') return folder;
  return std::filesystem::path(OUTRIDER_SOURCE_DIR) / ".." / "shared" / "data";
}

/// The text of `name` or `name.gz` below the folder of the grids; nothing when neither is there.
inline std::optional<std::string> text_of(const std::string& name) {
  for (const char* ending : {"", ".gz"}) {
    const auto path = data_folder() / "grids" / (name + ending);
    if (!std::filesystem::exists(path)) continue;
    gzFile file = gzopen(path.c_str(), "rb");  // reads plain files as they are
    std::string text;
    std::array<char, 1 << 16> chunk;
    for (int got = 0; (got = gzread(file, chunk.data(), static_cast<unsigned>(chunk.size()))) > 0;) {
      text.append(chunk.data(), static_cast<std::size_t>(got));
    }
    gzclose(file);
    return text;
  }
  return std::nullopt;
}

inline Grid<std::uint8_t> read_map(const std::string& text) {
  std::istringstream lines(text);
  std::string word, row;
  GridFrame frame;
  lines >> word >> word >> word >> frame.height >> word >> frame.width >> word;
  Grid<std::uint8_t> blocked(frame, 1);
  for (int y = frame.height - 1; y >= 0; --y) {
    lines >> row;
    for (int x = 0; x < frame.width; ++x) {
      const char c = row.at(static_cast<std::size_t>(x));
      blocked[{x, y}] = c == '.' || c == 'G' || c == 'S' ? 0 : 1;
    }
  }
  return blocked;
}

inline std::vector<Query> read_scen(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  std::vector<Query> queries;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string bucket, map, width, height;
    Query q;
    if (words >> bucket >> map >> width >> height >> q.start.x >> q.start.y >> q.goal.x >> q.goal.y >>
        q.length) {
      queries.push_back(q);
    }
  }
  return queries;
}

inline std::vector<Query> read_any_angle(std::string text) {
  for (char& c : text) c = c == ',' ? ' ' : c;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  std::vector<Query> queries;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    Query q;
    double octile = 0.0;
    if (words >> q.start.x >> q.start.y >> q.goal.x >> q.goal.y >> octile >> q.length) queries.push_back(q);
  }
  return queries;
}

/// testing::costly_cases(count) of the queries, or all, spread over the table, the last (the longest) among
/// them.
inline std::vector<Query> spread(const std::vector<Query>& all, std::size_t count) {
  const auto most = static_cast<std::size_t>(testing::costly_cases(static_cast<int>(count)));
  count = std::min(most, all.size());
  std::vector<Query> some;
  for (std::size_t i = 1; i <= count; ++i) some.push_back(all[i * all.size() / count - 1]);
  return some;
}

/// Limits the memory of an index of hubs, if the planner has one: it is whole on the smaller maps, a part on
/// some, and nothing on the others, where another planner answers. `make soak` builds the whole index of
/// every map.
inline void limit_hub_memory(const std::vector<Option>& options, const char* most_mib) {
  if (testing::costly_cases(1) > 1) return;
  for (const Option& option : options) {
    if (option.name == "hub_memory" && !assign(option, most_mib)) throw std::logic_error("hub_memory");
  }
}

}  // namespace outrider::movingai
