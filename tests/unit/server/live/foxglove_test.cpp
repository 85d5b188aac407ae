#include "live/foxglove.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>

#include "listener.hpp"

namespace outrider::server {
namespace {

// The tool writes the parts of a log one after the other, each when a file of its number appears.
const std::string step_script = R"sh(
for part in 1 2; do
  until [ -e go$part ]; do sleep 0.01; done
  [ -e part$part ] && cat part$part >&4
done
echo '{"status":"done"}'
)sh";

struct Data {
  std::uint32_t subscription = 0;
  std::uint64_t time_ns = 0;
  std::string bytes;
  friend bool operator==(const Data&, const Data&) = default;
};

std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) number = 256 * number + static_cast<unsigned char>(bytes[i]);
  return number;
}

/// Somebody who speaks the protocol with a viewer, without a socket.
class Client {
 public:
  explicit Client(App& app, const std::string& run = {}) : viewer_(app.live().open_foxglove(run)) {
    thread_ = std::thread([this] {
      viewer_->serve([this](FrameKind kind, const std::string& frame) { return take(kind, frame); });
    });
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() {
    viewer_->close();
    thread_.join();
  }
  bool say(const Json& message) { return viewer_->receive(message.dump()); }
  bool say_text(const std::string& text) { return viewer_->receive(text); }
  void subscribe(std::uint32_t id, std::uint32_t channel) {
    EXPECT_TRUE(say({{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}}));
  }
  /// Returns the next text message of that operation; others are let go.
  Json next(const std::string& op) {
    for (;;) {
      std::unique_lock lock(mutex_);
      if (!changed_.wait_for(lock, testing::patience, [this] { return !texts_.empty(); })) break;
      const Json message = texts_.front();
      texts_.pop_front();
      if (message["op"] == op) return message;
    }
    ADD_FAILURE() << "nothing of " << op;
    return {};
  }
  /// Returns the next messages of channels.
  std::vector<Data> data(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, testing::patience, [&] { return data_.size() >= count; }))
        << data_.size();
    const auto end = data_.begin() + static_cast<std::ptrdiff_t>(std::min(count, data_.size()));
    std::vector<Data> taken(data_.begin(), end);
    data_.erase(data_.begin(), end);
    return taken;
  }
  /// Waits for a message. Returns how many of another subscription are there then.
  std::ptrdiff_t count_when(const Data& comes, std::uint32_t other) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, testing::patience,
                                  [&] { return std::ranges::find(data_, comes) != data_.end(); }));
    return std::ranges::count(data_, other, &Data::subscription);
  }
  /// Returns how many messages wait; a moment later, so that more could have come.
  std::size_t waiting() {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    const std::lock_guard lock(mutex_);
    return data_.size();
  }
  std::vector<std::uint64_t> times() {
    const std::lock_guard lock(mutex_);
    return times_;
  }

 private:
  bool take(FrameKind kind, const std::string& frame) {
    const std::lock_guard lock(mutex_);
    const std::string_view bytes = frame;
    if (kind == FrameKind::text) {
      texts_.push_back(Json::parse(frame));
    } else if (bytes[0] == 2) {
      EXPECT_EQ(bytes.size(), 9U);
      times_.push_back(little_endian(bytes.substr(1)));
    } else {
      EXPECT_EQ(bytes[0], 1);
      data_.push_back({static_cast<std::uint32_t>(little_endian(bytes.substr(1, 4))),
                       little_endian(bytes.substr(5, 8)), std::string(bytes.substr(13))});
    }
    changed_.notify_all();
    return true;
  }

  std::shared_ptr<Viewer> viewer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Json> texts_;
  std::deque<Data> data_;
  std::vector<std::uint64_t> times_;
  std::thread thread_;
};

class FoxgloveTest : public AppTest {
 protected:
  FoxgloveTest() { write_tool(step_script); }  // the server must know where it is when it starts
  /// Starts a mission that writes the log in two parts: the first has `bytes` bytes.
  std::string start(const std::string& log, std::size_t bytes) {
    write("a.yaml", "job: guard\n");
    for (const char* old : {"go1", "go2"}) std::filesystem::remove(path(old));
    write("part1", log.substr(0, bytes));
    write("part2", log.substr(bytes));
    write_tool(step_script);
    return json("POST", "/api/v1/runs", R"({"scenario":"a.yaml"})", 202)["id"];
  }
};

TEST(Foxglove, TheBestSubprotocolIsSpoken) {
  const std::pair<const char*, const char*> cases[] = {
      {"", ""},
      {"foxglove.websocket.v1", "foxglove.websocket.v1"},
      {"foxglove.websocket.v1, foxglove.sdk.v1", "foxglove.sdk.v1"},
      {"mqtt,foxglove.websocket.v1", "foxglove.websocket.v1"},
      {"foxglove.websocket.v2", ""},
      {" , ,", ""}};
  for (const auto& [offered, spoken] : cases) EXPECT_EQ(foxglove::subprotocol_of(offered), spoken) << offered;
}

TEST(Foxglove, MessagesAreAsTheSpecificationSays) {
  EXPECT_EQ(foxglove::message_data(0x04030201, 0x0c0b0a0908070605, "data"),
            "\x01\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b\x0c"
            "data");
  EXPECT_EQ(foxglove::time(0x0807060504030201), "\x02\x01\x02\x03\x04\x05\x06\x07\x08");
  EXPECT_EQ(foxglove::unadvertise(3, 2), R"({"op":"unadvertise","channelIds":[3,4]})");
  EXPECT_EQ(foxglove::status(foxglove::Level::warning, "Late."),
            R"({"op":"status","level":1,"message":"Late."})");
}

TEST_F(FoxgloveTest, ChannelsOfARunningMissionAreListedAndDecoded) {
  const std::string log = log_of(5000);
  Client client(app());
  const Json info = client.next("serverInfo");
  EXPECT_EQ(info["capabilities"], Json::parse(R"(["time"])"));
  EXPECT_EQ(client.next("advertise")["channels"], Json::array()) << "no mission runs";
  start(log, log.size() / 2);
  write("go1", "");
  const Json channels = client.next("advertise")["channels"];
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[0],
            Json::parse(R"({"id":1,"topic":"/b","encoding":"cdr","schemaName":"std_msgs/msg/String",)"
                        R"("schema":"string data\n","schemaEncoding":"ros2msg"})"));
  EXPECT_EQ(channels[1]["topic"], "/a");
  client.subscribe(70, channels[1]["id"]);
  const std::vector<Data> first = client.data(1000);
  write("go2", "");
  const std::vector<Data> rest = client.data(4000);
  for (std::uint64_t i = 1; i <= 5000; ++i) {
    ASSERT_EQ((i <= 1000 ? first[i - 1] : rest[i - 1001]), (Data{70, i, std::to_string(i)}));
  }
  EXPECT_NE(client.next("status")["message"].get<std::string>().find("has ended"), std::string::npos);
  // A later subscription gets its messages from the beginning, by itself.
  client.subscribe(71, channels[0]["id"]);
  const std::vector<Data> late = client.data(2);
  EXPECT_EQ(late[0], (Data{71, 0, "first"}));
  EXPECT_EQ(late[1], (Data{71, 5001, "last"}));
  EXPECT_EQ(client.waiting(), 0U);
  const std::vector<std::uint64_t> times = client.times();
  EXPECT_TRUE(std::ranges::is_sorted(times)) << "its clock never goes back";
}

TEST_F(FoxgloveTest, SubscriptionsThatAreMadeTogetherComeInTheOrderOfTime) {
  const std::string log = log_of(1000);
  start(log, log.size());
  write("go1", "");
  Client client(app());
  (void)client.next("advertise");
  (void)client.next("advertise");
  const Json both = {{{"id", 1}, {"channelId", 1}}, {{"id", 2}, {"channelId", 2}}};
  EXPECT_TRUE(client.say({{"op", "subscribe"}, {"subscriptions", both}}));
  const std::vector<Data> data = client.data(1001);
  EXPECT_EQ(data[0], (Data{1, 0, "first"}));
  EXPECT_EQ(data[1000], (Data{2, 1000, "1000"}));
  write("go2", "");
}

TEST_F(FoxgloveTest, WhatIsUnsubscribedComesNoMore) {
  const std::string log = log_of(3000);
  start(log, log.size() / 2);
  write("go1", "");
  Client client(app());
  (void)client.next("advertise");
  (void)client.next("advertise");
  client.subscribe(1, 2);
  (void)client.data(1);
  client.subscribe(1, 1);
  EXPECT_NE(client.next("status")["message"].get<std::string>().find("subscription 1 exists"),
            std::string::npos);
  client.subscribe(2, 2);
  EXPECT_NE(client.next("status")["message"].get<std::string>().find("has a subscription"),
            std::string::npos);
  client.subscribe(3, 99);
  EXPECT_NE(client.next("status")["message"].get<std::string>().find("no channel 99"), std::string::npos);
  EXPECT_TRUE(client.say({{"op", "unsubscribe"}, {"subscriptionIds", {1, 17}}}));
  // A later subscription comes after everything of subscription 1, and ends with the last message of all.
  client.subscribe(4, 1);
  const auto count = client.count_when({4, 0, "first"}, 1);
  EXPECT_LT(count, 2999);
  write("go2", "");
  EXPECT_EQ(client.count_when({4, 3001, "last"}, 1), count);
  EXPECT_EQ(client.next("status")["level"], 0) << "the run has ended";
  EXPECT_TRUE(client.say({{"op", "clientInfo"}, {"name", "tests"}})) << "other operations are let go";
  EXPECT_TRUE(client.say({{"op", "subscribe"}, {"subscriptions", {{{"id", "x"}}}}}));
  EXPECT_EQ(client.next("status")["level"], 2);
  for (const char* text : {"", "[]", "1", "{"}) EXPECT_FALSE(client.say_text(text)) << text;
}

TEST_F(FoxgloveTest, ANewRunReplacesTheChannelsOfTheOldOne) {
  const std::string log = log_of(100);
  const std::string first = start(log, log.size());
  write("go1", "");
  write("go2", "");
  ended(first);
  Client client(app());
  (void)client.next("advertise");
  EXPECT_EQ(client.next("advertise")["channels"].size(), 2U)
      << "the newest run that began, even if it has ended";
  client.subscribe(5, 2);
  EXPECT_EQ(client.data(100).size(), 100U);
  start(log, log.size());
  EXPECT_EQ(client.next("unadvertise")["channelIds"], Json::parse("[1,2]"));
  write("go1", "");
  const Json channels = client.next("advertise")["channels"];
  EXPECT_EQ(channels[1]["id"], 4);
  client.subscribe(5, 4);
  EXPECT_EQ(client.data(100)[99], (Data{5, 100, "100"}));
  Client of_first(app(), first);
  (void)of_first.next("advertise");
  EXPECT_EQ(of_first.next("advertise")["channels"].size(), 2U);
  write("go2", "");
}

TEST_F(FoxgloveTest, ALogThatIsDamagedIsSaidToBe) {
  std::string log = log_of(5000);
  log[log.size() / 2] = static_cast<char>(log[log.size() / 2] ^ 1);
  start(log, log.size());
  write("go1", "");
  write("go2", "");
  Client client(app());
  EXPECT_EQ(client.next("status")["level"], 2);
}

TEST_F(FoxgloveTest, SocketsAreOpenedByThoseWhoMay) {
  const auto status = [&](const std::string& where, std::map<std::string, std::string> headers) {
    const std::size_t question = std::min(where.find('?'), where.size());
    const std::string query = question == where.size() ? "" : where.substr(question + 1);
    headers.insert({{"host", "127.0.0.1:8080"}, {"upgrade", "websocket"}, {"sec-websocket-key", "x"}});
    const auto refused =
        app().refuse_socket({"GET", where.substr(0, question), query, std::move(headers), {}});
    return refused ? refused->status : 101;
  };
  const std::pair<std::string, std::string> protocol = {"sec-websocket-protocol", "foxglove.websocket.v1"};
  const std::pair<std::string, std::string> foreign = {"origin", "https://app.foxglove.dev"};
  for (const char* place : {"/", "/foxglove", "/?run="}) EXPECT_EQ(status(place, {protocol}), 101) << place;
  EXPECT_EQ(status("/", {}), 400);
  EXPECT_EQ(status("/", {{"sec-websocket-protocol", "mqtt"}}), 400);
  EXPECT_EQ(status("/api/v1/live", {}), 101);
  EXPECT_EQ(status("/elsewhere", {protocol}), 404);
  EXPECT_EQ(status("/?run=absent", {protocol}), 404);
  EXPECT_EQ(status("/", {protocol, foreign}), 403) << "a page of another site";
  app_.reset();
  settings_.token = "0123456789abcdef";
  EXPECT_EQ(status("/", {protocol}), 401);
  EXPECT_EQ(status("/?token=0123456789abcdef", {protocol}), 101);
  EXPECT_EQ(status("/?token=0123456789abcdef", {protocol, foreign}), 101) << "it was given the token";
  EXPECT_EQ(status("/?token=0123456789abcdeX", {protocol, foreign}), 403);
}

}  // namespace
}  // namespace outrider::server
