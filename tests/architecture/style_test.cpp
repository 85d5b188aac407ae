// House rules that a machine can check: determinism, no leftovers, files and functions of a size.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "sources.hpp"

namespace architecture {
namespace {

struct Rule {
  std::string name;
  std::regex forbidden;
  std::string example;  ///< text that the rule must catch
  std::function<bool(const Source&)> applies;
};

bool library(const Source& s) { return s.in_library(); }

/// The library reads the clock only to keep a budget of wall time, and to tell how long a job took.
bool has_no_clock(const Source& s) {
  return s.in_library() && s.path.find("core/budget.") == std::string::npos &&
         s.path != "src/path/routes/routes_parallel.hpp" && s.path != "src/job/clock.cpp";
}
bool draws_no_numbers(const Source& s) {
  return s.path.find("core/rng") == std::string::npos && !s.path.starts_with("tests/architecture/");
}
bool is_an_algorithm(const Source& s) { return s.in_library() && s.layer != "io" && s.layer != "log"; }

/// The tool prints through terminal.hpp, and makes text of JSON through output.hpp: both take any bytes.
bool is_the_tool(const Source& s) {
  const bool owner =
      s.path.find("/terminal.") != std::string::npos || s.path.find("/output.") != std::string::npos ||
      s.path.find("/progress.") != std::string::npos || s.path.find("/live_map.") != std::string::npos;
  return s.path.starts_with("apps/cli/") && !owner;
}

/// Limits that a process sets for reading hold for every file, because one place opens them all.
/// The others write, or open what is the server's own.
bool opens_through_the_gate(const Source& s) {
  static const std::set<std::string> others = {"src/io/files/file_lock.cpp",
                                               "src/io/files/open_file.cpp",
                                               "src/io/files/open_folder.cpp",
                                               "src/io/files/temporary_file.cpp",
                                               "src/log/bytes/byte_source.cpp",
                                               "src/log/bytes/byte_sink.cpp",
                                               "apps/server/files/temporary_folder.cpp"};
  const bool ours = s.in_library() || s.path.starts_with("apps/");
  return ours && !others.contains(s.path);
}

std::string joined(const char* a, const char* b) { return std::string(a) + b; }  // hides it from itself

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all = {
      {"random numbers come from Rng",
       std::regex(R"(std::random_device|\bs?rand\s*\(|std::\w+_distribution|std::(mt19937|minstd))"),
       "std::normal_distribution<double> d;", draws_no_numbers},
      {"no clock in the library",
       std::regex(R"(std::chrono::\w+_clock|\b(std::time|std::clock|gettimeofday|clock_gettime)\s*\()"),
       "std::chrono::steady_clock::now()", has_no_clock},
      {"no order of a hash table", std::regex(R"(std::unordered_)"), "std::unordered_map<int, int> m;",
       library},
      {"algorithms do not print", std::regex(R"(std::(cout|cerr|clog)|\bprintf\s*\(|fmt::print)"),
       "std::cerr << 1;", is_an_algorithm},
      {"the tool prints through one door", std::regex(R"(fmt::print|\.dump\(|\bf(puts|write)\s*\()"),
       "fmt::print(1);", is_the_tool},
      {"algorithms do not open files", std::regex(R"(std::[io]?fstream|\bfopen\s*\()"), "std::ifstream f;",
       is_an_algorithm},
      {"files are opened by read_file()",
       std::regex(R"(std::[io]?fstream|\bfopen\s*\(|\s::open(at)?\s*\(|\bgzopen\s*\(|SYS_open)"),
       "const int file = ::open(path, flags);", opens_through_the_gate},
      {"no using-directive in a header", std::regex(R"(\nusing namespace )"), "\nusing namespace std;",
       [](const Source& s) { return s.path.ends_with(".hpp"); }},
  };
  return all;
}

TEST(Style, RulesHold) {
  const auto all = sources({"include", "src", "apps", "research", "tests", "bench", "examples"});
  for (const Rule& rule : rules()) {
    EXPECT_TRUE(std::regex_search(rule.example, rule.forbidden)) << rule.name;
    for (const Source& source : all) {
      std::smatch found;
      if (!rule.applies(source) || !std::regex_search(source.code, found, rule.forbidden)) continue;
      ADD_FAILURE() << source.path << ": " << found.str() << ": " << rule.name;
    }
  }
}

TEST(Style, NothingIsLeftUndone) {
  const std::regex leftover(joined("\\b(TO", "DO|FIX") + joined("ME|XX", "X)\\b"));
  EXPECT_TRUE(std::regex_search(joined("// TO", "DO later"), leftover));
  for (const Source& source : sources({"include", "src", "apps", "research", "tests", "bench", "examples"})) {
    EXPECT_FALSE(std::regex_search(source.text, leftover)) << source.path;
  }
}

TEST(Style, NoPathOfOneMachine) {
  const std::regex machine(joined("[\"<](/home/|/ro", "ot/|/wo") + joined("rk/|/Use", "rs/)"));
  for (const Source& source : sources({"include", "src", "apps", "research", "tests", "bench", "examples"})) {
    EXPECT_FALSE(std::regex_search(source.text, machine)) << source.path;
  }
}

TEST(Style, UnitsWithThreadsRunUnderTheThreadSanitizer) {
  const std::regex threads(R"(std::(jthread|thread|async|atomic|mutex|condition_variable)\b|core/parallel)");
  std::ifstream makefile(OUTRIDER_SOURCE_DIR "/Makefile");
  std::set<std::string> named;
  for (std::string line; std::getline(makefile, line);) {
    if (!line.starts_with("THREADED_UNITS = ")) continue;
    std::istringstream words(line.substr(line.find('=') + 1));
    for (std::string word; words >> word;) named.insert(word);
  }
  ASSERT_FALSE(named.empty());
  for (const Source& source : sources({"include", "src", "apps/server"})) {
    if (!std::regex_search(source.text, threads)) continue;
    std::string unit = source.in_library() ? source.layer : "server";
    std::ranges::replace(unit, '/', '_');
    EXPECT_TRUE(named.contains(unit)) << source.path;
  }
}

TEST(Style, EveryHeaderOpensWithItsManual) {
  for (const Source& source : sources({"include", "src"})) {
    if (!source.path.ends_with(".hpp")) continue;
    EXPECT_TRUE(source.text.starts_with("// ")) << source.path;
    EXPECT_NE(source.text.find("\n#pragma once\n"), std::string::npos) << source.path;
  }
}

TEST(Style, CommentsBeginWithASentence) {
  const std::regex fragment(R"(\s*///?<? (Of|Whether|Who|What|By|Those|Where)\b.*)");
  EXPECT_TRUE(std::regex_match("  /// Of the disk, m.", fragment));
  for (const Source& source : sources({"include", "src", "apps", "research", "tests", "bench", "examples"})) {
    bool goes_on = false;
    for (const std::string& line : lines(source.text)) {
      const std::size_t begin = line.find_first_not_of(' ');
      const bool comment = begin != std::string::npos && line.compare(begin, 2, "//") == 0;
      EXPECT_FALSE(comment && !goes_on && std::regex_match(line, fragment)) << source.path << ": " << line;
      goes_on = comment;
    }
  }
}

constexpr std::size_t longest_file = 500;
constexpr std::size_t longest_of_nine_in_ten = 300;
constexpr std::size_t longest_function = 75;

/// Lines from the head of a function to its closing brace, for functions at namespace level: they
/// start and end in the first column.
std::size_t longest_function_in(const Source& source) {
  static const std::regex no_function(
      R"(^(namespace|struct|class|enum|union|extern|inline constexpr|constexpr|const |static const ).*)");
  std::size_t longest = 0;
  std::size_t head = 0;
  const std::vector<std::string> all = lines(source.code);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& line = all[i];
    const bool starts = !line.empty() && line[0] != ' ' && line[0] != '}' && line[0] != '#';
    if (starts) head = std::regex_match(line, no_function) && line.find('(') == std::string::npos ? 0 : i + 1;
    if (line.empty() || line[0] != '}') continue;
    if (head > 0) longest = std::max(longest, i + 2 - head);
    head = 0;
  }
  return longest;
}

TEST(Style, FilesAndFunctionsHaveASize) {
  std::vector<std::size_t> lengths;
  for (const Source& source : sources({"include", "src", "apps", "research"})) {
    lengths.push_back(lines(source.text).size());
    EXPECT_LE(lengths.back(), longest_file) << source.path;
    EXPECT_LE(longest_function_in(source), longest_function) << source.path;
  }
  std::sort(lengths.begin(), lengths.end());
  EXPECT_LE(lengths.at(lengths.size() * 9 / 10), longest_of_nine_in_ten);
  const Source sample{"", "", "", "namespace a {\nint f(int x) {\n  return x;\n}\n}\n"};
  EXPECT_EQ(longest_function_in(sample), 3U);
}

TEST(Style, FoldersHaveASize) {
  constexpr std::size_t largest = 22;
  std::map<std::string, std::size_t> files;
  for (const Source& source : sources({"include", "src", "apps", "research"}))
    ++files[source.path.substr(0, source.path.rfind('/'))];
  EXPECT_GT(files.size(), 50U);
  for (const auto& [folder, count] : files) EXPECT_LE(count, largest) << folder;
}

TEST(Style, CommentsAndLiteralsAreNoCode) {
  EXPECT_EQ(without_comments_and_literals("a /* b */ c // d\ne"), "a         c     \ne");
  EXPECT_EQ(without_comments_and_literals(R"(f("x\"y", 'z', 1'000))"), "f(      ,    , 1'000)");
  EXPECT_EQ(without_comments_and_literals("#include \"a.hpp\"\n"), "#include \"a.hpp\"\n");
}

}  // namespace
}  // namespace architecture
