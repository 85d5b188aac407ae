// ROS 2 bags in SQLite files. The order comes from a query over the small columns, by the index of times or
// by a sort that leaves the data of messages where it is; each message is then fetched by its row.
#include <fmt/format.h>

#include <map>
#include <set>

#include "bag/db3_database.hpp"
#include "formats.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_topics = 10000;

struct Db3Contents {
  std::vector<Channel> channels;
  std::map<std::int64_t, std::size_t> channel_of;  ///< of a topic, by its number
};

struct Db3Schema {
  std::string encoding;
  std::string text;
};

/// Refuses a table without one of the columns, or with one that hides the numbers of its rows.
Status require_columns(const Db3Database& database, const char* table,
                       std::initializer_list<const char*> names) {
  for (const char* name : names) {
    const bool hides_rows = std::string_view(name) == "rowid";
    auto there = database.has_column(table, name);
    if (!there) return pass_on(there);
    if (*there != hides_rows) continue;
    return bad_input(fmt::format("its table '{}' has {} column '{}', so it is no ROS 2 bag; name another",
                                 table, hides_rows ? "a" : "no stored", name),
                     database.path());
  }
  return {};
}

Status require_tables(const Db3Database& database) {
  for (const char* name : {"topics", "messages"}) {
    auto there = database.has_table(name);
    if (!there) return pass_on(there);
    if (!*there) {
      return bad_input(
          fmt::format("it is an SQLite database without a table '{}', so no ROS 2 bag; name another", name),
          database.path());
    }
  }
  auto topics = require_columns(database, "topics", {"id", "name", "type", "serialization_format", "rowid"});
  if (!topics) return topics;
  return require_columns(database, "messages", {"topic_id", "timestamp", "data", "rowid"});
}

tl::unexpected<Fault> too_much_text(const Db3Database& database) {
  return bad_input(
      fmt::format("the descriptions of its topics hold more than {} bytes, the most that is read",
                  most_channel_bytes),
      database.path());
}

/// The definitions of types; older bags have none.
Outcome<std::map<std::string, Db3Schema>> read_schemas(const Db3Database& database) {
  std::map<std::string, Db3Schema> schemas;
  auto there = database.has_table("message_definitions");
  if (!there) return pass_on(there);
  if (!*there) return schemas;
  auto columns = require_columns(database, "message_definitions",
                                 {"topic_type", "encoding", "encoded_message_definition", "rowid"});
  if (!columns) return pass_on(columns);
  auto rows = database.query(
      "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions ORDER BY rowid");
  if (!rows) return pass_on(rows);
  std::size_t bytes = 0;
  for (;;) {
    auto more = rows->step(database.path());
    if (!more) return pass_on(more);
    if (!*more) return schemas;
    bytes += rows->bytes(0).size() + rows->bytes(1).size() + rows->bytes(2).size();
    if (bytes > most_channel_bytes || schemas.size() > most_topics) return too_much_text(database);
    if (rows->bytes(2).empty()) continue;
    schemas.emplace(rows->bytes(0), Db3Schema{std::string(rows->bytes(1)), std::string(rows->bytes(2))});
  }
}

/// The channel of the current row of the table topics.
Channel channel_of_row(const Db3Query& row, const std::map<std::string, Db3Schema>& schemas) {
  Channel channel;
  channel.topic = row.bytes(1);
  channel.type = row.bytes(2);
  channel.encoding = row.bytes(3);
  if (const auto schema = schemas.find(channel.type); schema != schemas.end()) {
    channel.schema = schema->second.text;
    channel.schema_encoding = schema->second.encoding;
  }
  const std::pair<const char*, std::string_view> notes[] = {{"offered_qos_profiles", row.bytes(4)},
                                                            {"type_description_hash", row.bytes(5)}};
  for (const auto& [key, value] : notes) {
    if (!value.empty()) channel.metadata[key] = value;
  }
  return channel;
}

Outcome<Db3Query> query_topics(const Db3Database& database) {
  std::string columns = "id, name, type, serialization_format";
  for (const char* column : {"offered_qos_profiles", "type_description_hash"}) {
    auto there = database.has_column("topics", column);
    if (!there) return pass_on(there);
    columns += *there ? fmt::format(", {}", column) : ", NULL";
  }
  return database.query(fmt::format("SELECT {} FROM topics ORDER BY rowid", columns));
}

Outcome<Db3Contents> read_contents(const Db3Database& database) {
  auto schemas = read_schemas(database);
  if (!schemas) return pass_on(schemas);
  auto rows = query_topics(database);
  if (!rows) return pass_on(rows);
  Db3Contents contents;
  std::size_t bytes = 0;
  for (;;) {
    auto more = rows->step(database.path());
    if (!more) return pass_on(more);
    if (!*more) return contents;
    Channel channel = channel_of_row(*rows, *schemas);
    const auto id = rows->integer(0);
    if (!id || channel.topic.empty() || channel.type.empty()) {
      return bad_input("a row of its table 'topics' has no id, name or type", database.path());
    }
    bytes += text_bytes(channel);
    if (bytes > most_channel_bytes || contents.channels.size() >= most_topics) return too_much_text(database);
    if (!contents.channel_of.emplace(*id, contents.channels.size()).second) {
      return bad_input(fmt::format("two rows of its table 'topics' have the id {}", *id), database.path());
    }
    contents.channels.push_back(std::move(channel));
  }
}

class Db3Reader : public LogReader {
 public:
  Db3Reader(Db3Database database, Db3Contents contents, std::vector<bool> selected)
      : database_(std::move(database)), contents_(std::move(contents)), selected_(std::move(selected)) {}

  Status begin(const LogSelection& selection);
  [[nodiscard]] const std::vector<Channel>& channels() const override { return contents_.channels; }
  Outcome<std::optional<LogMessage>> next() override;

 private:
  [[nodiscard]] tl::unexpected<Fault> wrong_row(std::string_view sentence) const {
    return bad_input(fmt::format("message {} {}", order_.integer(0).value_or(0), sentence), database_.path());
  }

  Db3Database database_;
  Db3Contents contents_;
  std::vector<bool> selected_;  ///< by channel
  Db3Query order_;              ///< row, topic and time of each message, in the order of time
  Db3Query data_;               ///< the data of a row
  std::int64_t last_ns_ = std::numeric_limits<std::int64_t>::min();
  std::uint64_t bytes_read_ = 0;  ///< of the data of messages
  bool ended_ = false;
};

Status Db3Reader::begin(const LogSelection& selection) {
  auto order = database_.query(
      "SELECT rowid, topic_id, timestamp FROM messages WHERE timestamp >= ?1 AND timestamp <= ?2 "
      "ORDER BY timestamp, rowid");
  if (!order) return pass_on(order);
  auto data = database_.query("SELECT data FROM messages WHERE rowid = ?1");
  if (!data) return pass_on(data);
  order_ = std::move(*order);
  data_ = std::move(*data);
  order_.bind(1, selection.from_ns);
  order_.bind(2, selection.to_ns);
  return {};
}

Outcome<std::optional<LogMessage>> Db3Reader::next() {
  while (!ended_) {  // a query that is asked again after its end would start again
    auto more = order_.step(database_.path());
    ended_ = !more || !*more;
    if (!more) return pass_on(more);
    if (ended_) break;
    const auto row = order_.integer(0);
    const auto topic = order_.integer(1);
    const auto time = order_.integer(2);
    if (!row || !topic || !time) return wrong_row("has no topic or no time");
    const auto channel = contents_.channel_of.find(*topic);
    if (channel == contents_.channel_of.end()) return wrong_row("belongs to a topic that is not in the file");
    if (*time < last_ns_) return wrong_row("is earlier than the one before; the index of times is damaged");
    last_ns_ = *time;
    if (!selected_[channel->second]) continue;
    data_.reset();
    data_.bind(1, *row);
    auto found = data_.step(database_.path());
    if (!found) return pass_on(found);
    if (!*found) return wrong_row("is in the index of times only; the database is damaged");
    const std::string_view data = data_.bytes(0);
    bytes_read_ += data.size();
    if (bytes_read_ > database_.bytes())
      return wrong_row("shares its bytes with others; the database is damaged");
    return LogMessage{channel->second, *time, data};
  }
  return std::optional<LogMessage>{};
}

/// Returns a flag for each channel, true if it is selected. Fault: bad_input if a selected one is not in CDR.
Outcome<std::vector<bool>> select(const Db3Database& database, const Db3Contents& contents,
                                  const LogSelection& selection) {
  const std::set<std::string> topics(selection.topics.begin(), selection.topics.end());
  std::vector<bool> selected;
  for (const Channel& channel : contents.channels) {
    selected.push_back(topics.empty() || topics.contains(channel.topic));
    if (selected.back() && channel.encoding != "cdr") {
      return bad_input(
          fmt::format("the messages of {} are in the format '{}'; only cdr is read, so select other "
                      "topics",
                      excerpt(channel.topic), excerpt(channel.encoding)),
          database.path());
    }
  }
  return selected;
}

LogOpened read_db3(Outcome<Db3Database> database, const LogSelection& selection) {
  if (!database) return pass_on(database);
  if (auto there = require_tables(*database); !there) return pass_on(there);
  auto contents = read_contents(*database);
  if (!contents) return pass_on(contents);
  auto selected = select(*database, *contents, selection);
  if (!selected) return pass_on(selected);
  auto reader = std::make_unique<Db3Reader>(std::move(*database), std::move(*contents), std::move(*selected));
  if (auto begun = reader->begin(selection); !begun) return pass_on(begun);
  return reader;
}

}  // namespace

LogOpened open_db3(const std::string& path, const LogSelection& selection) {
  return read_db3(Db3Database::open(path), selection);
}

LogOpened open_db3_bytes(const std::string& name, std::string_view bytes, const LogSelection& selection) {
  return read_db3(Db3Database::open_bytes(name, bytes), selection);
}

}  // namespace outrider
