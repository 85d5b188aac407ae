// What the benchmarks share: the words they take, and how their rows are told.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "command.hpp"
#include "output.hpp"

namespace outrider::cli {

/// --scenarios FILE,...
void add_scenarios(Command& bench, std::vector<std::string>& paths, const std::string& sentence);
/// --maps NAME,... and the like, of which all are taken where none is given.
void add_names(Command& bench, const std::string& flag, std::vector<std::string>& names,
               const std::string& sentence = "names from 'outrider list'; all unless given");
/// --seeds N
void add_seeds(Command& bench, std::int64_t& seeds, const std::string& sentence);
/// --json
void add_json(Command& bench, bool& json);

/// The rows as one JSON object or as a table, by the row_json() and print_table() that stand beside Row;
/// the exit status.
template <class Row>
int tell(const std::string& job, const std::vector<Row>& rows, bool right, bool json) {
  if (json) {
    auto list = nlohmann::ordered_json::array();
    for (const Row& row : rows) list.push_back(row_json(row));
    print({{"status", right ? "done" : "not_done"}, {"job", job}, {"rows", std::move(list)}});
  } else {
    print_table(rows);
  }
  return right ? job_done : job_not_done;
}

}  // namespace outrider::cli
