#include "files/temporary_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/data.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Renames new contents over three files of which the second did not exist; renaming the last fails.
void rename_but_not_the_last(const test::Folder& folder, bool kept) {
  const auto at = [&](const char* name) { return (folder.path / name).string(); };
  std::vector<TemporaryFile> files;
  for (const char* name : {"a", "new", "last"}) {
    auto place = place_of(at(name));
    ASSERT_TRUE(place);
    auto file = TemporaryFile::write(std::move(*place), "2");
    ASSERT_TRUE(file);
    files.push_back(std::move(*file));
  }
  OldFiles old;
  for (const TemporaryFile& file : files) {
    auto one = TemporaryFile::keep_old(file);
    ASSERT_TRUE(one);
    old.push_back(std::move(*one));
  }
  EXPECT_TRUE(old[0]);
  EXPECT_FALSE(old[1]) << "there is nothing to keep";
  if (!kept) {
    for (const auto& entry : fs::directory_iterator(folder.path)) {
      if (fs::hard_link_count(entry) > 1 && entry.path().filename() != "a" &&
          test::bytes_of(entry.path()) == "1a")
        fs::remove(entry);
    }
  }
  fs::remove(at("last"));
  fs::create_directories(at("last/full"));
  const int error = rename_all(files, old);
  EXPECT_NE(error, 0);
  Status first;
  for (TemporaryFile& file : files) {
    if (auto ok = file.finish(error); !ok && first) first = ok;
  }
  ASSERT_FALSE(first);
  EXPECT_EQ(first.error().where, at("last")) << "the one that could not be renamed";
  EXPECT_EQ(first.error().code, FaultCode::cannot_write);
}

TEST(TemporaryFile, AFailedRenamingTakesTheOthersBack) {
  const test::Folder folder;
  folder.write("a", "1a");
  folder.write("last", "1l");
  rename_but_not_the_last(folder, true);
  EXPECT_EQ(test::bytes_of(folder.path / "a"), "1a");
  EXPECT_EQ(entries(folder.path), 2U) << "a and the folder last; nothing temporary, nothing new";
}

TEST(TemporaryFile, ANewFileStaysWhereTheOldOneCannotBeBroughtBack) {
  const test::Folder folder;
  folder.write("a", "1a");
  folder.write("last", "1l");
  rename_but_not_the_last(folder, false);
  EXPECT_EQ(test::bytes_of(folder.path / "a"), "2") << "better than none";
  EXPECT_FALSE(fs::exists(folder.path / "new"));
}

}  // namespace
}  // namespace outrider
