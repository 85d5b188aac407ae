#include "map_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "outrider/io/values.hpp"
#include "outrider/path/grid/grid_ground.hpp"

namespace outrider::cli {
namespace {

constexpr std::array<const char*, 2> change_flags = {"--block", "--free"};

Outcome<CellChange> change_of(const std::string& text, const std::string& where, bool blocked) {
  const std::string form = "x,y or x,y,width,height in whole cells, such as 3,4 or 3,4,10,1";
  const bool one_cell = std::count(text.begin(), text.end(), ',') == 1;
  auto numbers = parse_numbers(text, one_cell ? 2 : 4, where, form);
  if (!numbers) return pass_on(numbers);
  for (const double number : *numbers) {
    if (number != std::floor(number) || std::abs(number) > most_grid_side) {
      return bad_input(fmt::format("{} is no good; it takes {}", number, form), where);
    }
  }
  const auto whole = [&](std::size_t i) { return static_cast<int>((*numbers)[i]); };
  return CellChange{{whole(0), whole(1)}, one_cell ? 1 : whole(2), one_cell ? 1 : whole(3), blocked};
}

}  // namespace

void add_change_flags(Command& command) {
  for (const char* flag : change_flags) {
    const bool block = flag == change_flags.front();
    const std::string help =
        fmt::format("cells x,y or x,y,width,height, from the bottom left, that are {}; repeatable",
                    block ? "blocked once the map is read" : "freed after that");
    command.option(flag, help).repeatable().type("TEXT").group("What is asked");
  }
}

Status refuse_changes(const Command& flags) {
  for (const char* flag : change_flags) {
    if (!flags.given(flag)) continue;
    return bad_input(
        "it changes cells, and this ground has exact shapes; leave it out, or take a map of cells", flag);
  }
  return {};
}

Status change_cells(const Command& flags, MapFile& map) {
  const auto given = [&](const char* flag) { return flags.given(flag); };
  if (std::none_of(change_flags.begin(), change_flags.end(), given)) return {};
  if (map.ground) return refuse_changes(flags);
  auto ground = GridGround::of(map.blocked, GridModel::cells);
  if (!ground) return pass_on(ground);
  for (const char* flag : change_flags) {
    for (const std::string& text : flags.values(flag)) {
      const std::string where = fmt::format("{} {}", flag, text);
      auto change = change_of(text, where, flag == change_flags.front());
      if (!change) return pass_on(change);
      auto changed = ground->with({*change});
      if (!changed) {
        changed.error().where = where;
        return pass_on(changed);
      }
      ground = std::move(changed);
    }
  }
  for (std::size_t i = 0; i < map.blocked.cells.size(); ++i) {
    map.blocked.cells[i] = ground->blocked(map.blocked.frame.cell(i)) ? 1 : 0;
  }
  return {};
}

}  // namespace outrider::cli
