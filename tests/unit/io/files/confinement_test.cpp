#include "outrider/io/files/confinement.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <functional>

#include "outrider/io/files/files.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/io/map/world_file.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/io/scenario/targets.hpp"
#include "outrider/io/sdf/sdf.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

const std::string wall =
    "<sdf version='1.6'><model name='wall'><static>true</static><link name='l'><collision name='c'><geometry>"
    "<box><size>1 1 1</size></box></geometry></collision></link></model></sdf>";

/// A folder `inside`, which is served, beside a folder `outside`, which is not, and a witness of every file
/// of the latter that is opened: the kernel, by inotify, which knows nothing of how we open files.
class Confinement : public ::testing::Test {
 protected:
  Confinement() : witness_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    folder_.write("outside/model.sdf", wall);
    folder_.write("outside/secret.txt", "type=1 x=1 y=1\n");
    folder_.write("outside/map.pgm", "P2 2 2 255 0 0 0 0\n");
    folder_.write("inside/wall/model.sdf", wall);
    folder_.write("inside/a.txt", "a");
  }
  ~Confinement() override { ::close(witness_); }

  [[nodiscard]] fs::path inside() const { return folder_.path / "inside"; }
  [[nodiscard]] std::string outside(const std::string& name) const { return folder_.path / "outside" / name; }

  /// Runs `act` in a process that is confined to `inside`; gives what it returns and whether any file
  /// outside was opened.
  struct Seen {
    std::string said;
    bool opened_outside = false;
  };
  Seen confined(const std::function<std::string()>& act) {
    ::inotify_add_watch(witness_, (folder_.path / "outside").c_str(), IN_OPEN | IN_ACCESS);
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      const Status ok = confine_reading(inside().string());
      const std::string said = ok ? act() : to_string(ok.error());
      (void)!::write(ends[1], said.data(), said.size());
      ::_exit(0);
    }
    ::close(ends[1]);
    Seen seen;
    std::array<char, 4096> buffer{};
    for (ssize_t count = 0; (count = ::read(ends[0], buffer.data(), buffer.size())) > 0;) {
      seen.said.append(buffer.data(), static_cast<std::size_t>(count));
    }
    ::close(ends[0]);
    seen.opened_outside = ::read(witness_, buffer.data(), buffer.size()) > 0;
    return seen;
  }
  Seen reading(const std::string& path) {
    return confined([&] {
      const auto text = read_file(path);
      return text ? "read: " + *text : to_string(text.error());
    });
  }
  Seen loading(const std::string& world) {
    folder_.write("inside/yard.sdf", world);
    return confined([] {
      const auto loaded = load_sdf("yard.sdf");
      return loaded ? fmt::format("{} solids", loaded->world.solids.size()) : to_string(loaded.error());
    });
  }
  static std::string including(const std::string& uri) {
    return "<sdf version='1.6'><world name='w'><include>" + uri + "</include></world></sdf>";
  }

  test::Folder folder_;
  int witness_;
};

TEST_F(Confinement, ALinkIsReplacedAndNotWrittenThrough) {
  fs::create_symlink(outside("secret.txt"), inside() / "link.txt");
  const Seen seen = confined([&] {
    const Status ok = write_files({{"link.txt", "new"}, {"more.txt", "more"}});
    return ok ? *read_file("link.txt") : to_string(ok.error());
  });
  EXPECT_EQ(seen.said, "new");
  EXPECT_FALSE(seen.opened_outside);
  EXPECT_EQ(*read_file(outside("secret.txt")), "type=1 x=1 y=1\n");
}

TEST_F(Confinement, TheWitnessSeesWhatIsOpened) {
  ::inotify_add_watch(witness_, (folder_.path / "outside").c_str(), IN_OPEN);
  ASSERT_TRUE(read_file(outside("secret.txt")));
  std::array<char, 4096> buffer{};
  EXPECT_GT(::read(witness_, buffer.data(), buffer.size()), 0);
}

TEST_F(Confinement, FilesInsideAreRead) {
  EXPECT_EQ(reading("a.txt").said, "read: a");
  EXPECT_EQ(reading("wall/../a.txt").said, "read: a");
  EXPECT_EQ(reading((inside() / "a.txt").string()).said, "read: a");
  fs::create_symlink("a.txt", inside() / "link");
  EXPECT_EQ(reading("link").said, "read: a");
}

TEST_F(Confinement, NoNameAndNoLinkLeadsOut) {
  fs::create_symlink(outside("secret.txt"), inside() / "absolute_link");
  fs::create_symlink("../outside/secret.txt", inside() / "link");
  fs::create_directory_symlink("../outside", inside() / "folder");
  for (const std::string& path :
       {outside("secret.txt"), std::string("../outside/secret.txt"),
        std::string("wall/../../outside/secret.txt"), std::string("absolute_link"), std::string("link"),
        std::string("folder/secret.txt"), (inside() / "../outside/secret.txt").string(),
        std::string("/proc/self/environ"), std::string("/proc/self/root/etc/passwd"),
        std::string("/etc/passwd")}) {
    const Seen seen = reading(path);
    EXPECT_NE(seen.said.find("outside the folder"), std::string::npos) << path << ": " << seen.said;
    EXPECT_FALSE(seen.opened_outside) << path;
  }
}

TEST_F(Confinement, PipesAndDevicesDoNotBlock) {
  ASSERT_EQ(::mkfifo((inside() / "pipe").c_str(), 0600), 0);
  EXPECT_NE(reading("pipe").said.find("not a regular file"), std::string::npos);
  folder_.write("inside/pipe.sdf", including("<uri>pipe</uri>"));
  const Seen seen = confined([] { return to_string(load_sdf("pipe.sdf").error()); });
  EXPECT_NE(seen.said.find("not a regular file"), std::string::npos) << seen.said;
}

TEST_F(Confinement, AWorldMayIncludeWhatLiesInside) {
  const std::string floor =
      "<model name='floor'><static>true</static><link name='l'><collision "
      "name='c'><geometry><plane><normal>0 0 1"
      "</normal></plane></geometry></collision></link></model>";
  const std::string world = including("<uri>model://wall</uri>");
  EXPECT_EQ(loading(std::string(world).insert(world.find("<include>"), floor)).said, "2 solids");
}

/// These worlds got through a parser that guessed which files a world opens.
TEST_F(Confinement, NoWorldLeadsOut) {
  const std::string out = "../outside/model.sdf";
  const std::vector<std::string> uris = {"<uri>" + out + "</uri>",
                                         "<uri a='>'>" + out + "</uri>",
                                         "<uri a='</uri'>" + out + "</uri>",
                                         "<uri>file://" + out + "</uri>",
                                         "<uri>file://" + outside("model.sdf") + "</uri>",
                                         "<uri>model://../outside</uri>",
                                         "<uri>&#46;./outside/model.sdf</uri>",
                                         "<uri><![CDATA[" + out + "]]></uri>"};
  for (const std::string& uri : uris) {
    const Seen seen = loading(including(uri));
    EXPECT_FALSE(seen.opened_outside) << uri;
    EXPECT_EQ(seen.said.find("solids"), std::string::npos) << uri << ": " << seen.said;
  }
}

TEST_F(Confinement, NoChainOfWorldsLeadsOut) {
  for (int i = 0; i < 6; ++i) {
    const std::string next = i < 5 ? fmt::format("chain{}.sdf", i + 1) : "../outside/model.sdf";
    folder_.write(fmt::format("inside/chain{}.sdf", i), "<sdf version='1.6'><model name='m'><include><uri>" +
                                                            next + "</uri></include></model></sdf>");
  }
  const Seen seen = loading(including("<uri>chain0.sdf</uri>"));
  EXPECT_FALSE(seen.opened_outside);
  EXPECT_NE(seen.said.find("outside the folder"), std::string::npos) << seen.said;
}

TEST_F(Confinement, NoModelConfigLeadsOut) {
  folder_.write("inside/model.config", "<model><sdf>../outside/model.sdf</sdf></model>");
  for (const char* uri : {"<uri>file://.</uri>", "<uri>file://./</uri>", "<uri>model://.</uri>"}) {
    const Seen seen = loading(including(uri));
    EXPECT_FALSE(seen.opened_outside) << uri;
    EXPECT_EQ(seen.said.find("solids"), std::string::npos) << uri << ": " << seen.said;
  }
}

/// The readers of what scenarios name. tests/fuzz/confinement_fuzz.cpp goes through scenarios of every job.
TEST_F(Confinement, NoScenarioAndNoMapLeadsOut) {
  folder_.write("inside/yard.yaml", including("<uri>../outside/model.sdf</uri>"));  // SDF by another name
  folder_.write(
      "inside/map.yaml",
      "image: ../outside/map.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.6\n"
      "free_thresh: 0.2\n");
  const auto told = [](const auto& loaded) { return loaded ? "loaded" : to_string(loaded.error()); };
  const std::string targets = outside("secret.txt");
  const std::vector<std::pair<const char*, std::function<std::string()>>> readers = {
      {"world", [&] { return told(load_sdf("yard.yaml")); }},
      {"map of a world", [&] { return told(load_map("yard.yaml")); }},
      {"world of any kind", [&] { return told(load_world("yard.yaml")); }},
      {"scenario", [&] { return told(scenario_job("../outside/secret.txt")); }},
      {"targets", [&] { return told(load_targets("../outside/secret.txt")); }},
      {"targets by an absolute name", [&] { return told(load_targets(targets)); }},
      {"map", [&] { return told(load_map_server("map.yaml")); }},
      {"map of any kind", [&] { return told(load_map("map.yaml")); }}};
  for (const auto& [what, read] : readers) {
    const Seen seen = confined(read);
    EXPECT_FALSE(seen.opened_outside) << what;
    EXPECT_NE(seen.said.find("outside the folder"), std::string::npos) << what << ": " << seen.said;
  }
}

TEST_F(Confinement, ASuppliedFileIsReadInPlaceOfTheOneOnTheDisk) {
  const Seen seen = confined([] {
    supply_file("a.txt", "checked before");
    return *read_file("a.txt") + (file_exists("a.txt") ? ", there" : "") +
           (read_file("a.txt", 3) ? "" : ", too long for 3 bytes");
  });
  EXPECT_EQ(seen.said, "checked before, there, too long for 3 bytes");
}

TEST_F(Confinement, CannotBeUndoneOrMoved) {
  const Seen seen = confined([] { return to_string(confine_reading("/").error()); });
  EXPECT_NE(seen.said.find("confined already"), std::string::npos) << seen.said;
}

}  // namespace
}  // namespace outrider
