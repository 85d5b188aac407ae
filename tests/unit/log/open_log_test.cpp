#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "outrider/log/log_reader.hpp"
#include "support/bag_writer.hpp"
#include "support/data.hpp"
#include "support/db3_writer.hpp"
#include "support/read_log.hpp"

namespace outrider {
namespace {

using test::Db3Writer;
using test::ReadLog;
using test::ReadMessage;

class OpenLog : public ::testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path / name).string(); }
  void write(const std::string& name, const std::string& bytes) const { folder_.write(name, bytes); }
  void write_db3(const std::string& name, const std::string& other_topic,
                 const std::vector<ReadMessage>& messages) const {
    Db3Writer writer(path(name));
    writer.make_tables(false);
    writer.add_topic(1, other_topic, "a/msg/B", false);
    writer.add_topic(2, "/scan", "a/msg/B", false);
    for (const auto& message : messages) {
      writer.add_message(message.topic == "/scan" ? 2 : 1, message.time_ns, message.data);
    }
  }

  test::Folder folder_;
};

TEST_F(OpenLog, TheContentDecidesTheFormat) {
  test::BagWriter bag;
  bag.add_connection("/scan", "a/B");
  bag.add_chunk({{0, 5, "x"}});
  write("run.db3", bag.bytes());
  write_db3("run #1?.bag", "/odom", {{"/scan", 7, "y"}});
  EXPECT_EQ(test::read_all(open_log(path("run.db3"))).messages,
            (std::vector<ReadMessage>{{"/scan", 5, "x"}}));
  EXPECT_EQ(test::read_all(open_log(path("run #1?.bag"))).messages,
            (std::vector<ReadMessage>{{"/scan", 7, "y"}}));
}

TEST_F(OpenLog, RefusesWhatIsNoLog) {
  write("empty", "");
  write("text", "hello");
  write("old.bag", "#ROSBAG V1.2\n");
  EXPECT_NE(test::read_all(open_log(path("none"))).fault.find("no such file"), std::string::npos);
  EXPECT_NE(test::read_all(open_log(path("empty"))).fault.find("it is not a log"), std::string::npos);
  EXPECT_NE(test::read_all(open_log(path("text"))).fault.find("it is not a log"), std::string::npos);
  EXPECT_NE(test::read_all(open_log(path("old.bag"))).fault.find("rosbag migrate"), std::string::npos);
  EXPECT_NE(test::read_all(open_log(path("."))).fault.find("without metadata.yaml"), std::string::npos);
}

TEST_F(OpenLog, TheFilesOfAFolderAreOneLog) {
  write("metadata.yaml", "rosbag2_bagfile_information:\n  compression_mode: \"\"\n");
  write_db3("run_10.db3", "/tf", {{"/tf", 25, "e"}, {"/scan", 30, "f"}});
  write_db3("run_2.db3", "/odom", {{"/scan", 10, "b"}, {"/odom", 25, "d"}, {"/odom", 26, "z"}});
  write_db3("run_1.db3", "/odom", {{"/scan", 1, "a"}, {"/scan", 12, "c"}});
  const auto reader = open_log(path("."));
  ASSERT_TRUE(reader) << to_string(reader.error());
  EXPECT_EQ((*reader)->channels().size(), 3U);
  const std::vector<ReadMessage> all = {{"/scan", 1, "a"},  {"/scan", 10, "b"}, {"/scan", 12, "c"},
                                        {"/odom", 25, "d"}, {"/tf", 25, "e"},   {"/odom", 26, "z"},
                                        {"/scan", 30, "f"}};
  EXPECT_EQ(test::read_all(reader).messages, all);
  const LogSelection selection{.topics = {"/odom", "/tf"}, .to_ns = 25};
  EXPECT_EQ(test::read_all(open_log(path("."), selection)).messages, test::filter(all, selection));

  write("metadata.yaml", "  compression_mode: MESSAGE\n");
  EXPECT_NE(test::read_all(open_log(path("."))).fault.find("compressed by rosbag2"), std::string::npos);
}

TEST_F(OpenLog, WritesThatWaitInASecondFileAreRead) {
  Db3Writer writer(path("live.db3"));
  writer.run("PRAGMA journal_mode=WAL");
  writer.make_tables(false);
  writer.add_topic(1, "/scan", "a/msg/B", false);
  writer.add_message(1, 5, "x");
  const ReadLog log = test::read_all(open_log(path("live.db3")));
  EXPECT_EQ(log.fault, "");
  EXPECT_EQ(log.messages.size(), 1U);
}

}  // namespace
}  // namespace outrider
