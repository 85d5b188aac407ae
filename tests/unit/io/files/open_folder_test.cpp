#include "outrider/io/files/open_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "outrider/io/files/confinement.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

class OpenFolders : public ::testing::Test {
 protected:
  OpenFolders() {
    folder_.write("outside/x.txt", "secret");
    folder_.write("inside/a/x.txt", "x");
    fs::create_directory_symlink("../outside", inside() / "out");
    fs::create_directory_symlink("a", inside() / "in");
    fs::create_symlink("../../outside/x.txt", inside() / "a/link.txt");
  }
  [[nodiscard]] fs::path inside() const { return folder_.path / "inside"; }
  [[nodiscard]] OpenFolder gate() const { return *OpenFolder::open(inside().string()); }
  [[nodiscard]] std::string content(const std::string& name) const {
    return *read_file((folder_.path / name).string());
  }
  static bool opens(const Outcome<int>& descriptor) {
    if (descriptor) ::close(*descriptor);
    return descriptor.has_value();
  }

  test::Folder folder_;
};

TEST_F(OpenFolders, NoNameAndNoLinkLeadsAway) {
  EXPECT_TRUE(opens(gate().open_file("a/x.txt")));
  EXPECT_TRUE(gate().folder("a"));
  EXPECT_TRUE(gate().folder(""));
  for (const char* path : {"a/link.txt", "out/x.txt", "in/x.txt", "../outside/x.txt", "a/../../outside/x.txt",
                           "a", "", "absent", "/etc/hostname"}) {
    EXPECT_FALSE(opens(gate().open_file(path))) << path;
  }
  EXPECT_FALSE(opens(gate().open_file((inside() / "a/x.txt").string()))) << "an absolute path";
  for (const char* path : {"out", "in", "..", "a/x.txt", "absent", "/"})
    EXPECT_FALSE(gate().folder(path)) << path;
  for (const char* name : {"out", "in"}) EXPECT_FALSE(gate().make_folder(name)) << name;
  EXPECT_TRUE(gate().make_folder("a")) << "it is there";
  EXPECT_TRUE(gate().make_folder("new"));
  EXPECT_TRUE(fs::is_directory(inside() / "new"));
}

TEST_F(OpenFolders, StayTheSameWhenTheirNameIsExchanged) {
  const OpenFolder a = *gate().folder("a");
  fs::rename(inside() / "a", inside() / "away");
  fs::create_directory_symlink("../outside", inside() / "a");
  EXPECT_TRUE(a.write({{"y.txt", "y"}, {"z.txt", "z"}}));
  EXPECT_TRUE(a.rename("y.txt", "x.txt"));
  EXPECT_EQ(content("inside/away/x.txt"), "y");
  EXPECT_EQ(content("outside/x.txt"), "secret");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path / "outside"), {}), 1);
}

TEST_F(OpenFolders, WriteOverLinksAndNotThroughThem) {
  const OpenFolder a = *gate().folder("a");
  EXPECT_TRUE(a.write({{"link.txt", "new"}}));
  EXPECT_FALSE(fs::is_symlink(inside() / "a/link.txt"));
  EXPECT_EQ(content("inside/a/link.txt"), "new");
  fs::remove(inside() / "a/link.txt");
  fs::create_symlink("../../outside/new.txt", inside() / "a/link.txt");
  EXPECT_EQ(a.create_file("link.txt"), -1);
  EXPECT_EQ(a.create_file("x.txt"), -1) << "it is there";
  EXPECT_EQ(content("outside/x.txt"), "secret");
  EXPECT_FALSE(fs::exists(folder_.path / "outside/new.txt"));
}

TEST_F(OpenFolders, RemoveLinksAndFoldersOfFiles) {
  folder_.write("inside/deep/er/x.txt", "x");
  for (const char* name : {"a", "out", "deep", "absent"}) gate().remove(name);
  EXPECT_EQ(gate().names(10), (std::vector<std::string>{"deep", "in"}));
  EXPECT_EQ(content("outside/x.txt"), "secret");
}

TEST_F(OpenFolders, TellWhatIsInThem) {
  EXPECT_EQ(gate().names(10), (std::vector<std::string>{"a", "in", "out"}));
  EXPECT_EQ(gate().names(2).size(), 2U);
  EXPECT_TRUE(gate().status("a")->is_folder);
  EXPECT_FALSE(gate().status("out")->is_folder);
  EXPECT_FALSE(gate().status("absent"));
  const FileStatus before = *gate().folder("a")->status("x.txt");
  EXPECT_TRUE(before.is_file);
  EXPECT_EQ(before.bytes, 1U);
  EXPECT_EQ(before, *gate().folder("a")->status("x.txt"));
  EXPECT_TRUE(gate().folder("a")->write({{"x.txt", "y"}}));
  EXPECT_NE(before, *gate().folder("a")->status("x.txt"));
}

}  // namespace
}  // namespace outrider
