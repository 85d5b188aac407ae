#include "outrider/io/files/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <set>

#include "support/costly_cases.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

std::string gzip(const std::string& path, const std::string& content) {
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, content.data(), static_cast<unsigned>(content.size()));
  gzclose(file);
  return path;
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string long_text() {
  Rng rng(7);
  std::string text;
  while (text.size() < 1'000'000) text += std::to_string(rng.below(1000)) + "\n";
  return text;
}

TEST(ReadFile, PlainAndGzipGiveTheSameBytesWhateverTheName) {
  const test::Folder folder;
  const std::string text = long_text() + std::string("\0\r\xff", 3);
  EXPECT_EQ(*read_file(folder.write("plain.gz", text)), text);
  EXPECT_EQ(*read_file(gzip((folder.path / "packed").string(), text)), text);
  EXPECT_EQ(*read_file(folder.write("empty", "")), "");
}

TEST(ReadFile, LimitCountsDecompressedBytes) {
  const test::Folder folder;
  const std::string text(100'000, 'a');
  const auto packed = gzip((folder.path / "packed").string(), text);
  EXPECT_LT(fs::file_size(packed), 1000U);
  EXPECT_TRUE(read_file(packed, 100'000));
  const auto refused = read_file(packed, 99'999);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, packed);
  EXPECT_NE(refused.error().sentence.find("99999"), std::string::npos);
  EXPECT_TRUE(read_file(folder.write("none", ""), 0));
}

TEST(ReadFile, ASmallGzipFileOfVeryMuchIsRefused) {
  const test::Folder folder;
  const std::string path = (folder.path / "packed").string();
  EXPECT_EQ(read_file(gzip(path, std::string(std::size_t{16} << 20U, 'x')))->size(), std::size_t{16} << 20U);
  const auto bomb = read_file(gzip(path, std::string(std::size_t{20} << 20U, 'x')));
  ASSERT_FALSE(bomb);
  EXPECT_NE(bomb.error().sentence.find("more than 100 times its size; unpack it first"), std::string::npos);
  EXPECT_EQ(read_file(folder.write("plain", std::string(std::size_t{20} << 20U, 'x')))->size(),
            std::size_t{20} << 20U);
}

TEST(ReadFile, RefusesWhatIsNoReadableFile) {
  const test::Folder folder;
  const std::string missing = (folder.path / "missing").string();
  ASSERT_FALSE(read_file(missing));
  EXPECT_EQ(to_string(read_file(missing).error()), missing + ": there is no such file; check the path");
  EXPECT_NE(read_file(folder.path.string()).error().sentence.find("folder"), std::string::npos);
  EXPECT_FALSE(read_file(""));
  EXPECT_FALSE(read_file((folder.path / std::string(5000, 'x')).string()));
}

TEST(ReadFile, RefusesTruncatedAndDamagedGzip) {
  const test::Folder folder;
  const std::string packed = test::bytes_of(gzip((folder.path / "packed").string(), long_text()));
  const auto cut = read_file(folder.write("cut", packed.substr(0, packed.size() / 2)));
  ASSERT_FALSE(cut);
  EXPECT_NE(cut.error().sentence.find("cut short"), std::string::npos);
  std::string changed = packed;
  changed[packed.size() / 2] = static_cast<char>(changed[packed.size() / 2] ^ 0x55);
  EXPECT_FALSE(read_file(folder.write("changed", changed)));
}

TEST(WriteFile, ReplacesWholeFilesAndLeavesNothingElse) {
  const test::Folder folder;
  const std::string path = (folder.path / "out.txt").string();
  ASSERT_TRUE(write_file(path, "first"));
  ASSERT_TRUE(write_file(path, long_text()));
  EXPECT_EQ(test::bytes_of(path), long_text());
  EXPECT_EQ(entries(folder.path), 1U);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  EXPECT_EQ(static_cast<unsigned>(fs::status(path).permissions()), 0666U & ~mask);
}

TEST(WriteFiles, ChangesAllOrNone) {
  const test::Folder folder;
  const auto at = [&](const char* name) { return (folder.path / name).string(); };
  ASSERT_TRUE(write_files({{at("a"), "1"}, {at("b"), "2"}}));
  EXPECT_FALSE(write_files({{at("a"), "3"}, {at("absent/b"), "4"}}));
  EXPECT_FALSE(write_files({{at("a"), "3"}, {folder.path.string(), "4"}}));
  EXPECT_EQ(test::bytes_of(at("a")) + test::bytes_of(at("b")), "12");
  EXPECT_EQ(entries(folder.path), 2U);
  ASSERT_TRUE(write_files({{at("b"), "5"}, {at("c"), "6"}}));
  EXPECT_EQ(test::bytes_of(at("b")) + test::bytes_of(at("c")), "56");
}

TEST(WriteFile, FollowsSymbolicLinks) {
  const test::Folder folder;
  const std::string real = folder.write("real", "old");
  const fs::path link = folder.path / "link";
  fs::create_symlink(real, link);
  ASSERT_TRUE(write_file(link.string(), "new"));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(test::bytes_of(real), "new");
}

TEST(WriteFile, RefusesFoldersDevicesAndMissingFolders) {
  const test::Folder folder;
  EXPECT_FALSE(write_file(folder.path.string(), "x"));
  EXPECT_FALSE(write_file("/dev/null", "x"));
  EXPECT_FALSE(write_file("", "x"));
  const auto refused = write_file((folder.path / "no" / "file").string(), "x");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("make it first"), std::string::npos);
  EXPECT_EQ(entries(folder.path), 0U);
}

TEST(WriteFile, FailureHalfWayKeepsTheOldFileAndNothingElse) {
  const test::Folder folder;
  const std::string path = folder.write("out.txt", "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto refused = write_file(path, long_text());
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, FaultCode::cannot_write) << "the request was right";
  EXPECT_EQ(test::bytes_of(path), "old");
  EXPECT_EQ(entries(folder.path), 1U);
}

TEST(WriteFile, KeepsTheModeOfTheFileThatItReplaces) {
  const test::Folder folder;
  const std::string secret = folder.write("secret", "old");
  ::chmod(secret.c_str(), 0640);
  ASSERT_TRUE(write_files({{secret, "new"}, {(folder.path / "other").string(), "x"}}));
  EXPECT_EQ(test::bytes_of(secret), "new");
  EXPECT_EQ(static_cast<unsigned>(fs::status(secret).permissions()), 0640U);
}

TEST(WriteFile, RemovesWhatAKilledWriterLeftAndNothingOfALivingOne) {
  const test::Folder folder;
  const std::string abandoned = folder.write(".outrider-1-0.part", "left behind");
  const std::string in_use = folder.write(".outrider-1-1.part", "being written");
  const std::string other = folder.write(".outrider.part.txt", "not ours");
  const int descriptor = ::open(in_use.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
  ASSERT_TRUE(write_file((folder.path / "a").string(), "1"));
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(in_use));
  EXPECT_TRUE(fs::exists(other));
  ::close(descriptor);
}

/// The texts of the files with those names; all the same when the folder is whole.
std::set<std::string> versions(const fs::path& folder, const std::vector<std::string>& names) {
  std::set<std::string> texts;
  for (const std::string& name : names) texts.insert(test::bytes_of(folder / name).substr(0, 8));
  return texts;
}

/// Waits until no process renames files in the folder: write_files() holds a lock on it meanwhile.
void wait_for_writers(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
  ::close(descriptor);
}

/// Files of one version, in the folder.
std::vector<NamedContent> files_of_version(const fs::path& folder, const std::vector<std::string>& names,
                                           int version) {
  std::vector<NamedContent> files;
  for (const std::string& name : names)
    files.push_back({(folder / name).string(), fmt::format("{:08}", version) + std::string(20'000, 'x')});
  return files;
}

/// As under `flock FOLDER outrider run ... --out FOLDER`.
TEST(WriteFiles, AreWrittenIntoAFolderThatAnotherProgramHasLocked) {
  const test::Folder folder;
  const int descriptor = ::open(folder.path.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
  EXPECT_TRUE(write_files({{(folder.path / "a").string(), "1"}, {(folder.path / "b").string(), "2"}}));
  EXPECT_EQ(entries(folder.path), 2U);
  ::close(descriptor);
}

TEST(WriteFiles, OfTwoWritersAreAllOfOneOfThem) {
  const test::Folder folder;
  const std::vector<std::string> names = {"a", "b", "c", "report"};
  for (int round = 0; round < 8; ++round) {
    const pid_t other = ::fork();
    for (int i = 0; i < 3; ++i)
      if (!write_files(files_of_version(folder.path, names, 10 * round + (other == 0 ? 1 : 2)))) ::_exit(1);
    if (other == 0) ::_exit(0);
    int status = 1;
    ::waitpid(other, &status, 0);
    ASSERT_EQ(status, 0);
    ASSERT_EQ(versions(folder.path, names).size(), 1U) << "a mixture in round " << round;
  }
}

TEST(WriteFiles, AreAllOldOrAllNewWheneverTheWriterIsKilled) {
  const test::Folder folder;
  const std::vector<std::string> names = {"a", "b", "c", "report"};
  const auto version = [&](int i) { return files_of_version(folder.path, names, i); };
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(write_files(version(0)));
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
  Rng rng(11);
  std::set<std::string> seen;
  const int kills = testing::costly_cases(200);
  for (int kill = 0; kill < kills; ++kill) {
    std::array<int, 2> ends{};  // of a pipe through which the writer tells that a version is complete
    ASSERT_EQ(::pipe(ends.data()), 0);
    const pid_t writer = ::fork();
    if (writer == 0) {
      for (int i = 1; write_files(version(1000 * kill + i)) && ::write(ends[1], "x", 1) == 1; ++i) {
      }
      ::_exit(1);
    }
    ::close(ends[1]);
    char told = 0;
    for (std::uint64_t left = rng.below(3); left > 0; --left) ASSERT_EQ(::read(ends[0], &told, 1), 1);
    ::usleep(static_cast<useconds_t>(rng.below(static_cast<std::uint64_t>(2.0 * took.count()) + 1)));
    ASSERT_EQ(::waitpid(writer, nullptr, WNOHANG), 0) << "it is still writing when it is killed";
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    ::close(ends[0]);
    wait_for_writers(folder.path);
    const std::set<std::string> texts = versions(folder.path, names);
    ASSERT_EQ(texts.size(), 1U) << "a mixture after kill " << kill;
    seen.insert(*texts.begin());
  }
  EXPECT_GT(seen.size(), static_cast<std::size_t>(kills) / 3)
      << "many of the writers came as far as a new version";
  ASSERT_TRUE(write_files(version(1)));
  EXPECT_EQ(entries(folder.path), names.size());
}

}  // namespace
}  // namespace outrider
