#include "outrider/sweep/chunk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "outrider/core/sha256.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

void append_field(std::string& line, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    line += field;
    return;
  }
  line += '"';
  for (const char c : field) {
    if (c == '"') line += '"';
    line += c;
  }
  line += '"';
}

std::string last_line(std::size_t runs, std::string_view origin, std::string_view text) {
  return fmt::format("# {} runs, manifest {}, sha256 {}\n", runs, origin, sha256(text));
}

/// Returns where the last line begins; 0 if there is none.
std::size_t body_end(std::string_view text) {
  const std::size_t end = text.rfind("\n# ");
  return end == std::string_view::npos ? 0 : end + 1;
}

/// Returns the name of the column of a metric, which differs from those of keys.
std::string column_of(const std::string& metric, const std::vector<std::string>& fixed) {
  return std::ranges::count(fixed, metric) > 0 ? "metric." + metric : metric;
}

tl::unexpected<Fault> damaged(const std::string& name, std::string_view what) {
  return bad_input(fmt::format("the chunk is damaged ({}); remove the file and run the sweep again", what),
                   name);
}

/// Returns the first fields of a run: what it is given.
std::vector<std::string> given_fields(const Sweep& sweep, const SweepRun& run) {
  std::vector<std::string> fields = {fmt::format("{}", run.number), fmt::format("{}", run.seed)};
  if (sweep.sides() == 2) fields.emplace_back(run.side == 0 ? "a" : "b");
  for (const std::string& value : run.values) fields.push_back(printable(value));
  return fields;
}

/// Names the first thing in which a chunk differs from that of the sweep.
std::string difference(const Sweep& sweep, std::uint64_t chunk, std::string_view text) {
  const auto columns = fixed_columns(sweep);
  const auto here = given_fields(sweep, run_of(sweep, sweep.begin_of(chunk)));
  const auto names = csv_fields(take_line(text)), there = csv_fields(take_line(text));
  const bool same_keys = names.size() >= columns.size() && there.size() >= here.size() &&
                         std::equal(columns.begin(), columns.end(), names.begin());
  if (!same_keys) return "the keys that vary";
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (there[i] == here[i]) continue;
    return fmt::format("the {} of its first run ('{}' there, '{}' here)", i == 0 ? "number" : columns[i],
                       excerpt(there[i]), excerpt(here[i]));
  }
  return "its program, its scenario, a file that the scenario reads, --runs or --chunk-runs";
}

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) line += ',';
    append_field(line, fields[i]);
  }
  return line + "\n";
}

std::vector<std::string> csv_fields(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  if (quoted) return {};
  return fields;
}

void add_columns(std::vector<std::string>& into, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::ranges::find(into, name) == into.end()) into.push_back(name);
  }
}

std::vector<std::string> fixed_columns(const Sweep& sweep) {
  std::vector<std::string> columns = {"run", "seed"};
  if (sweep.sides() == 2) columns.emplace_back("side");
  for (std::string& key : keys_of(sweep)) columns.push_back(std::move(key));
  columns.insert(columns.end(), {"status", "reason"});
  return columns;
}

std::string chunk_text(const Sweep& sweep, const std::vector<SweepResult>& results, std::string_view origin) {
  std::vector<std::string> columns = fixed_columns(sweep);
  const std::vector<std::string> fixed = columns;
  std::map<std::string, std::size_t, std::less<>> column;  // of a metric
  for (const SweepResult& result : results) {
    for (const auto& [name, value] : result.metrics) {
      if (column.contains(name)) continue;
      column[name] = columns.size();
      columns.push_back(column_of(printable(name), fixed));
    }
  }
  std::string text = csv_line(columns);
  std::vector<std::string> fields;
  for (const SweepResult& result : results) {
    fields = given_fields(sweep, result.run);
    fields.push_back(printable(result.status));
    fields.push_back(printable(result.reason));
    fields.resize(columns.size());
    for (const auto& [name, value] : result.metrics) {
      if (std::isfinite(value)) fields[column.find(name)->second] = fmt::format("{}", value);
    }
    text += csv_line(fields);
  }
  return text + last_line(results.size(), origin, text);
}

std::string chunk_path(const std::string& folder, std::uint64_t chunk) {
  return fmt::format("{}/chunks/{:06}.csv", folder, chunk);
}

Status check_origin(const Sweep& sweep, std::uint64_t chunk, std::string_view origin, std::string_view text,
                    const std::string& name) {
  const std::string_view last = text.substr(body_end(text));
  if (last.find(fmt::format(", manifest {}, ", origin)) != last.npos) return {};
  if (last.find(", manifest ") == last.npos) return damaged(name, "its last line is missing");
  return bad_input(fmt::format("the chunk is of a sweep that differs in {}; restore manifest.json if it was "
                               "changed, else remove the chunk, and run the sweep again",
                               difference(sweep, chunk, text)),
                   name);
}

Status check_chunk(const Sweep& sweep, std::uint64_t chunk, std::string_view origin, std::string_view text,
                   const std::string& name) {
  const std::size_t end = body_end(text);
  const std::string_view body = text.substr(0, end), last = text.substr(end);
  if (!last.ends_with(fmt::format(", sha256 {}\n", sha256(body)))) {
    return damaged(name, "its content is not what its last line says");
  }
  if (auto ok = check_origin(sweep, chunk, origin, text, name); !ok) return ok;
  if (last != last_line(sweep.begin_of(chunk + 1) - sweep.begin_of(chunk), origin, body)) {
    return damaged(name, "it lacks runs");
  }
  return {};
}

Outcome<ChunkText> split_chunk(const Sweep& sweep, std::uint64_t chunk, std::string_view text,
                               const std::string& name) {
  std::string_view body = text.substr(0, body_end(text));
  const auto fixed = fixed_columns(sweep);
  const auto columns = csv_fields(take_line(body));
  if (columns.size() < fixed.size() || !std::equal(fixed.begin(), fixed.end(), columns.begin())) {
    return damaged(name, "it has columns of another sweep");
  }
  if (!body.starts_with(fmt::format("{},", sweep.begin_of(chunk)))) {
    return damaged(name, "it has runs of another chunk");
  }
  return ChunkText{{columns.begin() + static_cast<std::ptrdiff_t>(fixed.size()), columns.end()}, body};
}

Outcome<SweepTable> read_rows(const Sweep& sweep, std::uint64_t chunk, const ChunkText& text,
                              const std::string& name) {
  SweepTable table{.metrics = text.metrics, .rows = {}};
  const std::size_t columns = fixed_columns(sweep).size() + table.metrics.size();
  for (std::string_view body = text.lines; !body.empty();) {
    table.rows.push_back(csv_fields(take_line(body)));
    if (table.rows.back().size() != columns) {
      return damaged(name, fmt::format("line {} lacks fields", table.rows.size() + 1));
    }
  }
  if (table.rows.size() != sweep.begin_of(chunk + 1) - sweep.begin_of(chunk)) {
    return damaged(name, "it lacks runs");
  }
  return table;
}

}  // namespace outrider
