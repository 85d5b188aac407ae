#include "outrider/sweep/merge_chunks.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "outrider/core/sha256.hpp"
#include "outrider/io/files/file_lock.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/log/bytes/byte_sink.hpp"

namespace outrider {
namespace {

Outcome<std::vector<std::string>> all_metrics(ChunkReader& chunks) {
  std::vector<std::string> metrics;
  auto ok = chunks.for_each_text([&](std::uint64_t, const ChunkText& text, const std::string&) -> Status {
    add_columns(metrics, text.metrics);
    return {};
  });
  if (!ok) return pass_on(ok);
  return metrics;
}

/// Returns the lines of a chunk with the metrics of the whole table.
std::string widened(const SweepTable& table, std::size_t fixed, const std::vector<std::string>& metrics) {
  std::string text;
  std::vector<std::string> fields(fixed + metrics.size());
  for (const auto& row : table.rows) {
    std::ranges::fill(fields, std::string());
    std::copy_n(row.begin(), fixed, fields.begin());
    for (std::size_t i = 0; i < table.metrics.size(); ++i) {
      const auto place = std::ranges::find(metrics, table.metrics[i]) - metrics.begin();
      fields[fixed + static_cast<std::size_t>(place)] = row[fixed + i];
    }
    text += csv_line(fields);
  }
  return text;
}

/// Writes the merged table through `write`.
Status write_merged(ChunkReader& chunks, const std::vector<std::string>& metrics,
                    const std::function<Status(std::string_view)>& write) {
  std::vector<std::string> columns = fixed_columns(chunks.sweep());
  const std::size_t fixed = columns.size();
  columns.insert(columns.end(), metrics.begin(), metrics.end());
  if (auto ok = write(csv_line(columns)); !ok) return ok;
  return chunks.for_each_text(
      [&](std::uint64_t chunk, const ChunkText& text, const std::string& path) -> Status {
        if (text.metrics == metrics) return write(text.lines);  // as they are
        const auto table = read_rows(chunks.sweep(), chunk, text, path);
        if (!table) return pass_on(table);
        return write(widened(*table, fixed, metrics));
      });
}

}  // namespace

Outcome<std::string> merge_chunks(ChunkReader& chunks) {
  const auto metrics = all_metrics(chunks);
  if (!metrics) return pass_on(metrics);
  const std::string part = chunks.folder() + "/table.part";
  auto lock = FileLock::take(part);
  if (!lock) return pass_on(lock);
  if (!lock->held()) return std::string();
  auto sink = make_file_sink(part);
  if (!sink) return pass_on(sink);
  Sha256 hash;
  auto written = write_merged(chunks, *metrics, [&](std::string_view text) {
    hash.add(text);
    return (*sink)->write(text);
  });
  if (written) written = (*sink)->close();
  if (written) written = write_files({}, {{chunks.folder() + "/table.csv", part}});
  if (!written) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    return pass_on(written);
  }
  return hash.hex();
}

}  // namespace outrider
