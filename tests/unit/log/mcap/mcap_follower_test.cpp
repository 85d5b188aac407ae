// MCAP files that are read while they are written.
#include "outrider/log/mcap/mcap_follower.hpp"

#include <filesystem>
#include <fstream>

#include "mcap_logs.hpp"

namespace outrider::testing {
namespace {

class McapFollowerTest : public ::testing::Test {
 protected:
  McapFollowerTest()  // a file of its own, since tests run at the same time
      : path_(::testing::TempDir() + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
              ".mcap") {
    std::ofstream(path_).close();
  }
  ~McapFollowerTest() override { std::filesystem::remove(path_); }

  void append(std::string_view bytes) const {
    std::ofstream(path_, std::ios::app | std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  std::string path_;
};

/// Reads what is complete by now; returns a fault as text.
std::string read_on(McapFollower& log, OwnMessages& messages) {
  for (;;) {
    const auto bytes = log.next();
    if (!bytes) return to_string(bytes.error());
    if (*bytes == 0) return {};
    const Status read = log.read([&](const LogMessage& message) {
      messages.push_back({log.channels()[message.channel].topic, message.time_ns, std::string(message.data)});
    });
    if (!read) return to_string(read.error());
  }
}

TEST_F(McapFollowerTest, AtEachByteItHasTheChunksThatAreComplete) {
  Rng rng(1);
  const OwnMessages messages = random_messages(rng, 60);
  const std::string bytes = mcap_of(messages, {.compression = Codec::none, .chunk_bytes = 200});
  McapFollower log(path_);
  OwnMessages read;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    append(bytes.substr(i, 1));
    ASSERT_EQ(read_on(log, read), "") << i;
  }
  EXPECT_EQ(read, messages);
  const auto whole = read_all(bytes);
  ASSERT_EQ(log.channels().size(), whole.channels.size());
  for (const Channel& channel : whole.channels) {
    EXPECT_EQ(std::count(log.channels().begin(), log.channels().end(), channel), 1) << channel.topic;
  }
}

TEST_F(McapFollowerTest, ASecondOneComesToTheSamePlace) {
  Rng rng(2);
  append(mcap_of(random_messages(rng, 100), {.compression = Codec::lz4, .chunk_bytes = 300}));
  McapFollower one(path_), two(path_);
  OwnMessages read_by_one, read_by_two;
  EXPECT_EQ(read_on(one, read_by_one), "");
  EXPECT_EQ(read_on(two, read_by_two), "");
  EXPECT_EQ(read_by_one, read_by_two);
  EXPECT_EQ(one.position(), two.position());
}

TEST_F(McapFollowerTest, WhatIsNoLogIsRefused) {
  append("this is no log at all");
  McapFollower log(path_);
  OwnMessages read;
  EXPECT_NE(read_on(log, read).find("does not begin as an MCAP file"), std::string::npos);
  McapFollower absent(path_ + ".absent");
  EXPECT_FALSE(absent.next());
}

TEST_F(McapFollowerTest, DamageIsSaid) {
  Rng rng(3);
  std::string bytes = mcap_of(random_messages(rng, 50), {.compression = Codec::none, .chunk_bytes = 1 << 20});
  bytes[bytes.size() / 3] = static_cast<char>(bytes[bytes.size() / 3] ^ 1);
  append(bytes);
  McapFollower log(path_);
  OwnMessages read;
  EXPECT_NE(read_on(log, read).find("checksum"), std::string::npos);
}

}  // namespace
}  // namespace outrider::testing
