#include "outrider/io/files/file_lock.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "outrider/io/files/files.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

TEST(FileLock, IsHeldByOneAtATime) {
  const test::Folder folder;
  const std::string path = folder.write("log", "content");
  {
    const auto first = FileLock::take(path);
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->held());
    const auto second = FileLock::take(path);
    ASSERT_TRUE(second);
    EXPECT_FALSE(second->held());
  }
  EXPECT_TRUE(FileLock::take(path)->held());
  EXPECT_EQ(*read_file(path), "content");
}

TEST(FileLock, MakesTheFileAndSaysWhyItCannot) {
  const test::Folder folder;
  const std::string path = folder.write("there", "") + "-new";
  EXPECT_TRUE(FileLock::take(path)->held());
  EXPECT_TRUE(std::filesystem::exists(path));
  const auto nowhere = FileLock::take(path + "/no/file");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, FaultCode::cannot_write);
  EXPECT_EQ(nowhere.error().where, path + "/no/file");
}

TEST(WriteFiles, RenamesACompleteFileTogetherWithTheOthers) {
  const test::Folder folder;
  const std::string log = folder.write("running.mcap", "all of it"), at = log + ".to", other = log + ".other";
  ASSERT_TRUE(write_files({{other, "more"}}, {{at, log}}));
  EXPECT_FALSE(std::filesystem::exists(log));
  EXPECT_EQ(*read_file(at), "all of it");
  EXPECT_EQ(*read_file(other), "more");
}

TEST(WriteFiles, RefusesACompleteFileThatIsNotThere) {
  const test::Folder folder;
  const std::string other = folder.write("other", "old");
  const auto done = write_files({{other, "new"}}, {{other + ".to", other + ".none"}});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, FaultCode::cannot_write);
  EXPECT_EQ(*read_file(other), "old");
}

}  // namespace
}  // namespace outrider
