// Writes small ROS 2 bags as SQLite files.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace outrider::test {

class Db3Writer {
 public:
  /// In memory, unless a path is given.
  explicit Db3Writer(const std::string& path = ":memory:") {
    if (sqlite3_open(path.c_str(), &database_) != SQLITE_OK) throw std::runtime_error("cannot open " + path);
  }
  Db3Writer(const Db3Writer&) = delete;
  Db3Writer& operator=(const Db3Writer&) = delete;
  ~Db3Writer() { sqlite3_close(database_); }

  void run(const std::string& sql) {
    if (sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
      throw std::runtime_error(sqlite3_errmsg(database_));
    }
  }

  /// The tables of ROS 2 Humble, or of Jazzy with its definitions of types.
  void make_tables(bool with_definitions, bool with_index = true) {
    const std::string hash = with_definitions ? ", type_description_hash TEXT NOT NULL" : "";
    run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL" +
        hash + ")");
    run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
    if (with_index) run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
    if (!with_definitions) return;
    run("CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT "
        "NOT NULL,"
        "encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL)");
  }
  void add_topic(int id, const std::string& name, const std::string& type, bool with_definitions,
                 const std::string& format = "cdr") {
    run("INSERT INTO topics VALUES(" + std::to_string(id) + ",'" + name + "','" + type + "','" + format +
        "','- depth: 10'" + (with_definitions ? ",'RIHS01_0')" : ")"));
  }
  void add_message(std::int64_t topic, std::int64_t time_ns, std::string_view data) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database_, "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", -1,
                       &statement, nullptr);
    sqlite3_bind_int64(statement, 1, topic);
    sqlite3_bind_int64(statement, 2, time_ns);
    sqlite3_bind_blob(statement, 3, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
  }

  [[nodiscard]] std::string bytes() const {
    sqlite3_int64 size = 0;
    unsigned char* image = sqlite3_serialize(database_, "main", &size, 0);
    std::string copy(reinterpret_cast<const char*>(image), static_cast<std::size_t>(size));
    sqlite3_free(image);
    return copy;
  }

 private:
  sqlite3* database_ = nullptr;
};

}  // namespace outrider::test
