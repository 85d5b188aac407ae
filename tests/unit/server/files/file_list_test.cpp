#include "files/file_list.hpp"

#include "app_fixture.hpp"

namespace outrider::server {
namespace {

class FileListTest : public AppTest {
 protected:
  /// Paths and kinds, as in "a.yaml scenario".
  static std::vector<std::string> kinds(const Outcome<Json>& listed) {
    std::vector<std::string> all;
    for (const Json& file : listed->at("files"))
      all.push_back(file["path"].get<std::string>() + " " + file["kind"].get<std::string>());
    return all;
  }
  [[nodiscard]] Folder folder() const { return *Folder::open(path("").string()); }
};

TEST_F(FileListTest, LooksOnceIntoAFileThatStaysAsItIs) {
  for (int i = 0; i < 100; ++i) write("a/" + std::to_string(i) + ".yaml", "job: cover\n");
  write("b.yaml", "job: cover\n");
  EXPECT_EQ(json("GET", "/api/v1/files")["files"].size(), 101U);
  EXPECT_EQ(questions_, 1);
  const Json before = json("GET", "/api/v1/files");
  EXPECT_EQ(questions_, 1);
  EXPECT_EQ(ask("PUT", "/api/v1/files/b.yaml", "# Mow.\njob: cover\n").status, 200);
  const Json after = json("GET", "/api/v1/files");
  EXPECT_EQ(questions_, 2);
  EXPECT_EQ(after["files"][100]["description"], "Mow.");
  EXPECT_EQ(after["files"][99], before["files"][99]);
}

/// One file that is too much for the reader hides none of the others, and is looked into once more, alone.
TEST_F(FileListTest, WhatCannotBeReadWithinTheLimitsIsAnotherFile) {
  for (const char* name : {"a.yaml", "b.yaml", "c.yaml"}) write(name, "job: cover\n");
  const Folder served = folder();
  std::vector<std::size_t> asked;
  FileList files(served, [&](const Folder& place, const Json& question, const std::stop_token& stop) {
    asked.push_back(question["kinds"].size());
    for (const Json& path : question["kinds"]) {
      if (path == "b.yaml") return Outcome<Json>(fault(FaultCode::budget_exhausted, "too much"));
    }
    return read_here()(place, question, stop);
  });
  const std::vector<std::string> expected = {"a.yaml scenario", "b.yaml other", "c.yaml scenario"};
  EXPECT_EQ(kinds(files.list({})), expected);
  EXPECT_EQ(kinds(files.list({})), expected);
  EXPECT_EQ(asked, (std::vector<std::size_t>{3, 1, 1, 1}));
}

TEST_F(FileListTest, KnowsNothingOfWhatWasNotRead) {
  write("a.yaml", "job: cover\n");
  const Folder served = folder();
  bool busy = true;
  FileList files(served, [&](const Folder& place, const Json& question, const std::stop_token& stop) {
    if (busy) return Outcome<Json>(fault(FaultCode::cancelled, "ask again"));
    return read_here()(place, question, stop);
  });
  EXPECT_EQ(files.list({}).error().code, FaultCode::cancelled);
  busy = false;
  EXPECT_EQ(kinds(files.list({})), (std::vector<std::string>{"a.yaml scenario"}));
}

/// Large files are not read together, so that the limits are those of one.
TEST_F(FileListTest, ReadsAtMostAMebibyteAtATime) {
  for (const char* name : {"a.yaml", "b.yaml", "c.yaml"})
    write(name, "job: cover\n" + std::string(600'000, '#') + "\n");
  EXPECT_EQ(json("GET", "/api/v1/files")["files"].size(), 3U);
  EXPECT_EQ(questions_, 3);
}

TEST_F(FileListTest, HasNoLinks) {
  write("a/x.yaml", "job: cover\n");
  std::filesystem::create_directory_symlink("a", path("b"));
  std::filesystem::create_symlink("x.yaml", path("a/y.yaml"));
  const Json listed = json("GET", "/api/v1/files");
  ASSERT_EQ(listed["files"].size(), 1U);
  EXPECT_EQ(listed["files"][0]["path"], "a/x.yaml");
  EXPECT_EQ(ask("GET", "/api/v1/files/b/x.yaml").status, 404);
  EXPECT_EQ(ask("GET", "/api/v1/files/a/y.yaml").status, 404);
}

}  // namespace
}  // namespace outrider::server
