// Maps for the tests of the job plan, and a run of it from keys and values.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/job/run_job.hpp"
#include "outrider/jobs/plan/job.hpp"
#include "support/data.hpp"

namespace outrider {

// A room with a wall of two blocks that share an edge; the way is round its end.
inline const std::string room =
    "(0,0) (8,0) (8,6) (0,6)\n---\n(3,0) (4,0) (4,2) (3,2)\n(4,2) (3,2) (3,4) (4,4)\n---\n(1,1) (7,1)\n"
    "(1,5) (7,5)\n";
// 6 x 4 cells with a wall from the top that leaves a gap in the lowest row.
inline const std::string cells = "type octile\nheight 4\nwidth 6\nmap\n...@..\n...@..\n...@..\n......\n";

class PlanCase : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) {
    return folder_.write(name, content);
  }
  /// Runs the job with these keys.
  static Outcome<outrider::Run> plan(const Changes& changes, const RunWatch& watch = {}) {
    const Job job = plan_job();
    const auto task = job.blank();
    if (auto ok = change(*task, changes); !ok) return pass_on(ok);
    return run_task(job, *task, watch);
  }
  /// The fault, or "taken".
  static std::string refusal(const Changes& changes) {
    const auto run = plan(changes);
    return run ? "taken, " + run->report.status : to_string(run.error());
  }
  test::Folder folder_;
};

/// A value of a row of the table "rows".
template <class Value>
Value value(const Run& run, std::size_t row, std::string_view column) {
  const Table& table = run.report.tables.at(0);
  return TableRow{table, table.rows.at(row)}.get<Value>(column);
}
inline double number_of(const Run& run, std::size_t row, std::string_view column) {
  return value<double>(run, row, column);
}
inline std::string text_of(const Run& run, std::size_t row, std::string_view column) {
  return value<std::string>(run, row, column);
}
inline std::vector<Vec2> waypoints_of(const Run& run, std::size_t row) {
  return value<std::vector<Vec2>>(run, row, "waypoints");
}
inline std::size_t rows_of(const Run& run) { return run.report.tables.at(0).rows.size(); }

/// The setting of that key, as the report keeps it.
inline std::string setting(const Run& run, std::string_view key) {
  for (const auto& [name, text] : run.report.settings) {
    if (name == key) return text;
  }
  return "none";
}

}  // namespace outrider
