// Each layer uses only layers to its left: in what it includes, and in what its target links.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "sources.hpp"

namespace architecture {
namespace {

/// How far to the right a layer stands; layers of one rank do not see each other.
const std::map<std::string, int> rank = {
    {"core", 0},        {"geometry", 1},   {"world", 2},        {"motion", 3},     {"search", 4},
    {"path", 5},        {"pursuit", 5},    {"tour", 5},         {"ballistics", 5}, {"estimate", 5},
    {"control", 5},     {"slam", 5},       {"log", 5},          {"picture", 6},    {"report", 6},
    {"robot", 6},       {"io", 6},         {"navigate", 7},     {"sim", 8},        {"job", 8},
    {"jobs/cover", 9},  {"jobs/drive", 9}, {"jobs/explore", 9}, {"jobs/fleet", 9}, {"jobs/plan", 9},
    {"jobs/pursue", 9}, {"jobs/slam", 9},  {"jobs/guard", 10},  {"jobs", 11},      {"sweep", 11},
    {"nodes", 12},      {"ros2", 13},
};

bool may_use(const std::string& layer, const std::string& used) {
  return layer == used || (rank.contains(layer) && rank.contains(used) && rank.at(used) < rank.at(layer));
}

std::vector<std::string> layers_included(const std::string& text) {
  static const std::regex include(R"(#\s*include\s*["<]outrider/(jobs/[a-z0-9_]+(?=/)|[a-z0-9_]+)/)");
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
    found.push_back((*it)[1]);
  }
  return found;
}

TEST(Layers, EveryFolderHasARank) {
  for (const Source& source : sources({"include/outrider", "src"})) {
    const bool umbrella = source.path == "include/outrider/outrider.hpp";
    EXPECT_TRUE(umbrella || rank.contains(source.layer)) << source.path;
  }
}

TEST(Layers, IncludesPointLeft) {
  int seen = 0;
  for (const Source& source : sources({"include/outrider", "src"})) {
    if (source.path == "include/outrider/outrider.hpp") continue;
    for (const std::string& used : layers_included(source.code)) {
      ++seen;
      EXPECT_TRUE(may_use(source.layer, used)) << source.path << " includes " << used;
    }
  }
  EXPECT_GT(seen, 20) << "the sources were not found";
}

TEST(Layers, NothingIncludesTheApplications) {
  const std::regex apps(R"(#\s*include\s*["<](.*/)?apps/)");
  for (const Source& source : sources({"include", "src", "bench"})) {
    EXPECT_FALSE(std::regex_search(source.code, apps)) << source.path;
  }
}

TEST(Layers, TargetsLinkLeft) {
  std::ifstream file(OUTRIDER_LINKS);
  ASSERT_TRUE(file) << OUTRIDER_LINKS;
  int seen = 0;
  for (std::string line; std::getline(file, line); ++seen) {
    std::istringstream words(line);
    std::string layer;
    words >> layer;
    EXPECT_TRUE(rank.contains(layer)) << layer;
    for (std::string used; words >> used;) {
      EXPECT_TRUE(layer != used && may_use(layer, used)) << layer << " links to " << used;
    }
  }
  EXPECT_GE(seen, 4);
}

TEST(Layers, HeavyHeadersStayOutOfPublicHeaders) {
  const std::regex heavy(
      R"(#\s*include\s*[<"](boost|polyclipping|sdf|dart|assimp|ceres|ompl|tbb|oneapi|Eigen/(?!Core>)|apriltag|turbojpeg|pugixml|yaml-cpp|CLI|nlohmann/json\.hpp))");
  EXPECT_TRUE(std::regex_search(std::string("#include <sdf/sdf.hh>"), heavy));
  EXPECT_TRUE(std::regex_search(std::string("#include <Eigen/Dense>"), heavy));
  EXPECT_FALSE(std::regex_search(std::string("#include <Eigen/Core>"), heavy));
  for (const Source& source : sources({"include"})) {
    EXPECT_FALSE(std::regex_search(source.code, heavy)) << source.path;
  }
}

TEST(Layers, TheCommandLineIsParsedBehindOneDoor) {
  const std::regex parser(R"(#\s*include\s*[<"]CLI)");
  for (const Source& source : sources({"include", "src", "apps", "research"})) {
    EXPECT_EQ(std::regex_search(source.code, parser), source.path == "apps/cli/command.cpp") << source.path;
  }
}

/// The types that a header defines in namespaces, as "outrider::tour::Proof"; a definition stands at the
/// margin.
std::vector<std::string> types_defined(const std::string& code) {
  static const std::regex line(
      R"((?:^|\n)(?:namespace ([a-z_:]+) \{|(?:struct|class|enum class|enum) (\w+)\b(?!::)[^;\n]*\{))");
  std::vector<std::string> found;
  std::string space;
  for (std::sregex_iterator it(code.begin(), code.end(), line), end; it != end; ++it) {
    if ((*it)[1].matched) space = (*it)[1].str() + "::";
    if ((*it)[2].matched) found.push_back(space + (*it)[2].str());
  }
  return found;
}

/// Two types of one name in one namespace are one type to the linker, which keeps either's destructor.
TEST(Layers, ATypeIsDefinedOnce) {
  std::map<std::string, std::string> home;
  for (const Source& source : sources({"include", "src", "apps", "research"})) {
    if (!source.path.ends_with(".hpp")) continue;
    for (const std::string& type : types_defined(source.code)) {
      const auto [first, added] = home.emplace(type, source.path);
      EXPECT_TRUE(added) << type << " in " << first->second << " and " << source.path;
    }
  }
  EXPECT_GT(home.size(), 200U) << "the types were not found";
}

TEST(Layers, TheRuleItselfRefuses) {
  EXPECT_TRUE(may_use("world", "core"));
  EXPECT_FALSE(may_use("world", "jobs/guard"));
  EXPECT_FALSE(may_use("jobs/cover", "jobs/drive"));
  EXPECT_FALSE(may_use("path", "tour"));
  EXPECT_FALSE(may_use("core", "apps"));
  EXPECT_EQ(layers_included("#include \"outrider/path/mesh/mesh.hpp\"\n"), std::vector<std::string>{"path"});
  EXPECT_EQ(layers_included("#include \"outrider/jobs/guard/plan/plan.hpp\"\n"),
            std::vector<std::string>{"jobs/guard"});
  EXPECT_EQ(layers_included("#include \"outrider/jobs/job.hpp\"\n"), std::vector<std::string>{"jobs"});
  EXPECT_EQ(types_defined("namespace outrider {\nclass A;\nstruct B : A {\n  struct C {};\n};\n"),
            std::vector<std::string>{"outrider::B"});
}

}  // namespace
}  // namespace architecture
