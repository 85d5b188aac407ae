// SQLite databases from strangers: opened to be read only, with limits, and without what a schema could run.
// The work is bounded by the size of the file, since pages of a forged one may be visited again and again.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

inline constexpr int largest_db3_value = 256 << 20;  ///< bytes of a text or blob

/// A query and its current row. The texts of a row are valid until the next call of step().
class Db3Query {
 public:
  Db3Query() = default;
  explicit Db3Query(sqlite3_stmt* statement) : statement_(statement) {}

  void bind(int parameter, std::int64_t value);
  /// Goes to the next row, or to the first; false at the end. Fault: bad_input, if the file is damaged.
  Outcome<bool> step(const std::string& path);
  void reset();

  /// Nothing, if the column of the row is no integer.
  [[nodiscard]] std::optional<std::int64_t> integer(int column) const;
  /// The bytes of a text or blob; empty, if the column holds neither.
  [[nodiscard]] std::string_view bytes(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class Db3Database {
 public:
  /// Fault: bad_input, if it cannot be opened, or if its end is missing.
  static Outcome<Db3Database> open(const std::string& path);
  /// The same from memory; it keeps a copy of the bytes.
  static Outcome<Db3Database> open_bytes(const std::string& name, std::string_view bytes);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// Fault: bad_input, for instance if a column of the query is missing.
  Outcome<Db3Query> query(const std::string& sql) const;
  /// Returns true if there is an ordinary table of this name: neither a view nor a virtual table.
  [[nodiscard]] Outcome<bool> has_table(const std::string& name) const;
  /// Returns true if the rows of the table hold a column of this name, in capitals or not; a column that is
  /// computed is none.
  [[nodiscard]] Outcome<bool> has_column(const std::string& table, const std::string& column) const;

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  };
  /// The work that a connection may still do, in steps of SQLite's machine and pages that it visits.
  struct Effort {
    sqlite3* database = nullptr;
    std::int64_t left = 0;
    static int count(void* effort);
  };
  Db3Database(sqlite3* database, std::string path, std::uint64_t bytes)
      : effort_(new Effort{database, 0}), database_(database), path_(std::move(path)), bytes_(bytes) {}
  Status harden() const;
  [[nodiscard]] Outcome<bool> any_row(const std::string& sql) const;

  std::unique_ptr<Effort> effort_;
  std::unique_ptr<sqlite3, Close> database_;
  std::string path_;
  std::uint64_t bytes_;  ///< of the database, with its last writes in a second file
};

}  // namespace outrider
