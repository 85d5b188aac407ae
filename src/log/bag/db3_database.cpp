#include "bag/db3_database.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "bytes/byte_source.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr int steps_between_counts = 1000;

tl::unexpected<Fault> refuse(sqlite3* database, const std::string& path) {
  const std::string says = sqlite3_errmsg(database);
  switch (sqlite3_errcode(database) & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return bad_input(
          fmt::format("the database is damaged ({}); \"sqlite3 FILE .recover\" saves what is left", says),
          path);
    case SQLITE_TOOBIG:
      return bad_input(
          fmt::format("a value holds more than {} bytes, the most that is read", largest_db3_value), path);
    case SQLITE_INTERRUPT:
      return bad_input(
          "reading takes more work than a database of its size can need, so it is damaged; \"sqlite3 FILE "
          ".recover\" saves what is left",
          path);
    default: return bad_input(fmt::format("SQLite cannot read it: {}", printable(says.substr(0, 100))), path);
  }
}

/// A big-endian number in the header of the file.
std::uint64_t header_number(std::string_view header, std::size_t at, std::size_t length) {
  std::uint64_t value = 0;
  for (const char digit : header.substr(at, length)) value = value << 8 | static_cast<unsigned char>(digit);
  return value;
}

/// SQLite notices a missing end only when it gets there; the header says how long the file has to be
/// (sqlite.org/fileformat2.html, 1.3).
Status check_length(const ByteSource& source) {
  constexpr std::size_t header_length = 100;
  auto header = source.read(0, header_length);
  if (!header) return pass_on(header);
  const std::uint64_t page = header_number(*header, 16, 2);
  const std::uint64_t page_bytes = page == 1 ? 65536 : page;
  const std::uint64_t pages = header_number(*header, 28, 4);
  const bool pages_known = header_number(*header, 24, 4) == header_number(*header, 92, 4);
  if (pages_known && pages * page_bytes > source.size()) {
    return damaged(source, source.size(),
                   fmt::format("its end is missing: the database has {} bytes", pages * page_bytes),
                   "copy it again, or save what is left by \"sqlite3 FILE .recover\"");
  }
  return {};
}

/// Returns the size of a file; 0 if there is none.
std::uint64_t size_of(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

/// The file as a URI. A database that nobody writes is read without locks and without making files beside it;
/// one whose last writes lie in a second file is read together with that.
std::string uri_of(const std::string& path) {
  std::string uri = "file:";
  const std::string absolute = std::filesystem::absolute(path).string();
  for (const char c : absolute) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/';
    uri += plain ? std::string(1, c) : fmt::format("%{:02x}", static_cast<unsigned char>(c));
  }
  uri += "?mode=ro";
  if (size_of(path + "-wal") == 0 && size_of(path + "-journal") == 0) uri += "&immutable=1";
  return uri;
}

/// Sets the limits that sqlite.org/security.html recommends for untrusted files.
void set_limits(sqlite3* database) {
  constexpr std::array<std::pair<int, int>, 11> limits = {{{SQLITE_LIMIT_LENGTH, largest_db3_value},
                                                           {SQLITE_LIMIT_SQL_LENGTH, 100000},
                                                           {SQLITE_LIMIT_COLUMN, 100},
                                                           {SQLITE_LIMIT_EXPR_DEPTH, 20},
                                                           {SQLITE_LIMIT_COMPOUND_SELECT, 3},
                                                           {SQLITE_LIMIT_VDBE_OP, 25000},
                                                           {SQLITE_LIMIT_FUNCTION_ARG, 8},
                                                           {SQLITE_LIMIT_ATTACHED, 0},
                                                           {SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 50},
                                                           {SQLITE_LIMIT_TRIGGER_DEPTH, 10},
                                                           {SQLITE_LIMIT_WORKER_THREADS, 0}}};
  for (const auto& [limit, value] : limits) sqlite3_limit(database, limit, value);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
}

}  // namespace

void Db3Query::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), parameter, value);
}

Outcome<bool> Db3Query::step(const std::string& path) {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE) return false;
  return refuse(sqlite3_db_handle(statement_.get()), path);
}

void Db3Query::reset() { sqlite3_reset(statement_.get()); }

std::optional<std::int64_t> Db3Query::integer(int column) const {
  if (sqlite3_column_type(statement_.get(), column) != SQLITE_INTEGER) return std::nullopt;
  return sqlite3_column_int64(statement_.get(), column);
}

std::string_view Db3Query::bytes(int column) const {
  const int type = sqlite3_column_type(statement_.get(), column);
  if (type != SQLITE_TEXT && type != SQLITE_BLOB) return {};
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  if (bytes == nullptr) return {};
  const int length = sqlite3_column_bytes(statement_.get(), column);
  return {static_cast<const char*>(bytes), static_cast<std::size_t>(length)};
}

int Db3Database::Effort::count(void* effort) {
  auto& work = *static_cast<Effort*>(effort);
  int visits = 0, misses = 0, highest = 0;
  sqlite3_db_status(work.database, SQLITE_DBSTATUS_CACHE_HIT, &visits, &highest, 1);
  sqlite3_db_status(work.database, SQLITE_DBSTATUS_CACHE_MISS, &misses, &highest, 1);
  work.left -= steps_between_counts + std::int64_t{visits} + misses;
  return work.left < 0 ? 1 : 0;  // 1 interrupts the query
}

Status Db3Database::harden() const {
  // The shortest row takes 10 bytes, and some 35 steps and visits, to be sorted and to be read.
  constexpr std::int64_t steps_of_a_byte = 10, steps_of_any = 100'000;
  effort_->left = steps_of_any + steps_of_a_byte * static_cast<std::int64_t>(bytes_);
  sqlite3_progress_handler(database_.get(), steps_between_counts, Effort::count, effort_.get());
  set_limits(database_.get());
  // Sorting goes to a file in the folder for temporary files when it needs more than the cache: 8 MiB.
  const char* pragmas =
      "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0; PRAGMA temp_store=FILE; PRAGMA cache_size=-8192;"
      "PRAGMA query_only=ON;";
  if (sqlite3_exec(database_.get(), pragmas, nullptr, nullptr, nullptr) == SQLITE_OK) return {};
  return refuse(database_.get(), path_);
}

Outcome<Db3Database> Db3Database::open(const std::string& path) {
  auto source = open_file_source(path);
  if (!source) return pass_on(source);
  if (auto whole = check_length(**source); !whole) return pass_on(whole);
  sqlite3* made = nullptr;
  const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
  const int result = sqlite3_open_v2(uri_of(path).c_str(), &made, flags, nullptr);
  Db3Database database(made, path, (*source)->size() + size_of(path + "-wal"));
  if (result != SQLITE_OK) return refuse(made, path);
  if (auto done = database.harden(); !done) return pass_on(done);
  return database;
}

Outcome<Db3Database> Db3Database::open_bytes(const std::string& name, std::string_view bytes) {
  if (auto whole = check_length(*memory_source(bytes, name)); !whole) return pass_on(whole);
  sqlite3* made = nullptr;
  const int result = sqlite3_open_v2(":memory:", &made, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  Db3Database database(made, name, bytes.size());
  if (result != SQLITE_OK) return refuse(made, name);
  const auto size = static_cast<sqlite3_int64>(bytes.size());
  auto* image = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
  if (image == nullptr) return bad_input("there is no memory left to read it", name);
  std::copy(bytes.begin(), bytes.end(), image);
  constexpr unsigned flags = SQLITE_DESERIALIZE_READONLY | SQLITE_DESERIALIZE_FREEONCLOSE;
  if (sqlite3_deserialize(made, "main", image, size, size, flags) != SQLITE_OK) return refuse(made, name);
  if (auto done = database.harden(); !done) return pass_on(done);
  return database;
}

Outcome<Db3Query> Db3Database::query(const std::string& sql) const {
  sqlite3_stmt* statement = nullptr;
  const int length = static_cast<int>(sql.size());
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), length, &statement, nullptr) != SQLITE_OK) {
    return refuse(database_.get(), path_);
  }
  return Db3Query(statement);
}

Outcome<bool> Db3Database::any_row(const std::string& sql) const {
  auto rows = query(sql);
  if (!rows) return pass_on(rows);
  return rows->step(path_);
}

Outcome<bool> Db3Database::has_table(const std::string& name) const {
  return any_row(
      fmt::format("SELECT 1 FROM sqlite_schema WHERE type = 'table' AND name = '{}' AND rootpage > 0", name));
}

Outcome<bool> Db3Database::has_column(const std::string& table, const std::string& column) const {
  return any_row(
      fmt::format("SELECT 1 FROM pragma_table_xinfo('{}') WHERE name = '{}' COLLATE NOCASE AND hidden = 0",
                  table, column));
}

}  // namespace outrider
