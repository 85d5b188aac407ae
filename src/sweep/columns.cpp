#include "outrider/sweep/columns.hpp"

#include <algorithm>
#include <limits>

#include "outrider/io/files/text.hpp"

namespace outrider {

Outcome<Outcomes> read_outcomes(ChunkReader& chunks,
                                const std::function<void(std::uint64_t run, const std::string& status,
                                                         const std::string& reason)>& each) {
  const Sweep& sweep = chunks.sweep();
  Outcomes outcomes;
  outcomes.status_of.reserve(sweep.total);
  const std::size_t status_column = fixed_columns(sweep).size() - 2;
  auto ok = chunks.for_each_table([&](const SweepTable& table) {
    add_columns(outcomes.metrics, table.metrics);
    for (const auto& row : table.rows) {
      const std::string& status = row[status_column];
      add_columns(outcomes.statuses, {status});
      const auto found = std::ranges::find(outcomes.statuses, status) - outcomes.statuses.begin();
      outcomes.status_of.push_back(static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(found, 255)));
      if (status != "done") each(outcomes.status_of.size() - 1, status, row[status_column + 1]);
    }
  });
  if (!ok) return pass_on(ok);
  return outcomes;
}

Outcome<std::vector<Column>> read_columns(ChunkReader& chunks, const std::vector<std::string>& names) {
  const Sweep& sweep = chunks.sweep();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto fixed = fixed_columns(sweep);
  std::vector<Column> columns;
  for (const std::string& name : names) {
    columns.push_back({name, {}});
    columns.back().values.reserve(sweep.total);
  }
  auto ok = chunks.for_each_table([&](const SweepTable& table) {
    auto all = fixed;
    all.insert(all.end(), table.metrics.begin(), table.metrics.end());
    for (Column& column : columns) {
      const auto place = static_cast<std::size_t>(std::ranges::find(all, column.name) - all.begin());
      for (const auto& row : table.rows) {
        column.values.push_back(place == all.size() ? none : number<double>(row[place]).value_or(none));
      }
    }
  });
  if (!ok) return pass_on(ok);
  return columns;
}

}  // namespace outrider
