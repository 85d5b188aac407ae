#include "outrider/io/map/pursuit_map.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <sstream>

#include "support/data.hpp"
#include "support/replaced.hpp"

namespace outrider {
namespace {

const std::string small_pursuit =
    "N\n3,2\nC\n100\nR\n1,2\nT\n3 , 1\n2,1\nM\n1.0000,25.0\n 50, 0\n 7.00 ,100\n";

std::string fault(const std::string& text) {
  const auto problem = pursuit_map_from_text(text, "m");
  return problem ? "none" : to_string(problem.error());
}

TEST(PursuitMap, RowsAreColumnsAndCellsCountFromOne) {
  for (const std::string& text :
       {small_pursuit, test::replaced(small_pursuit, "3,2", "3.0 , 2"), small_pursuit + "\n \n"}) {
    const auto problem = pursuit_map_from_text(text, "m");
    ASSERT_TRUE(problem) << to_string(problem.error());
    EXPECT_EQ(problem->costs->frame, (GridFrame{{0, 0}, 1.0, 3, 2}));
    EXPECT_EQ(problem->costs->cells, (std::vector<std::uint32_t>{1, 50, 7, 25, 0, 100}));
    EXPECT_EQ(problem->threshold, 100U);
    EXPECT_EQ(problem->start, (Cell{0, 1}));
    EXPECT_EQ(problem->target, (std::vector<Cell>{{2, 0}, {1, 0}}));
    EXPECT_EQ(problem->start_s, 0);
  }
}

TEST(PursuitMap, WholeNumbersInAnyForm) {
  for (const char* form : {"25", "25.", "25.000", "2.5e1", "+25", " 25 ", "\t25.0\t", "0025", "250e-1"}) {
    const auto problem = pursuit_map_from_text(test::replaced(small_pursuit, "25.0", form), "m");
    ASSERT_TRUE(problem) << form << to_string(problem.error());
    EXPECT_EQ(problem->costs->cells[3], 25U) << form;
  }
  std::string dos;
  for (const char c : small_pursuit) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_TRUE(pursuit_map_from_text(dos, "m"));
}

TEST(PursuitMap, FaultsNameTheLineAndTheRemedy) {
  const auto with = [](const std::string& from, const std::string& to) {
    return fault(test::replaced(small_pursuit, from, to));
  };
  EXPECT_EQ(with("1.0000,25.0", "1"), "m:11: row 1 of the costs has 1 values; the size says 2");
  EXPECT_EQ(with("1.0000,25.0", "1,2,3"), "m:11: row 1 of the costs has 3 values; the size says 2");
  EXPECT_EQ(with("25.0", "abc"),
            "m:11: 'abc' is no cost (value 2 of this row); expected a whole number from 0 to 1000000000");
  for (const char* bad : {"-1", "2.5", "nan", "inf", "", "1 2", "1e10", "12345678901"}) {
    EXPECT_TRUE(with("25.0", bad).starts_with("m:11: ")) << bad << with("25.0", bad);
  }
  EXPECT_EQ(with("3 , 1", "4,1"),
            "m:8: '4,1' puts the target off the map; expected x,y, whole numbers from 1,1 to 3,2");
  EXPECT_TRUE(with("3 , 1", "3,0").starts_with("m:8: '3,0' is no cell"));
  EXPECT_TRUE(with("3 , 1", "3").starts_with("m:8: '3' is no cell"));
  EXPECT_TRUE(with("1,2\nT", "1,3\nT").starts_with("m:6: '1,3' puts the robot off the map"));
  EXPECT_TRUE(with("3,2\nC", "0,2\nC").starts_with("m:2: '0,2' is no size"));
  EXPECT_TRUE(with("C", "c").starts_with("m:3: 'c' is not valid; this line is 'C'"));
  EXPECT_TRUE(with("100\nR", "-100\nR").starts_with("m:4: '-100' is no threshold"));
  EXPECT_TRUE(with("3 , 1\n2,1\n", "").starts_with("m:8: the target has no cells"));
  EXPECT_TRUE(with(" 7.00 ,100\n", "").find("ends") != std::string::npos);
  EXPECT_TRUE(with(" 7.00 ,100\n", " 7.00 ,100\n1,1\n").starts_with("m:14: a row of costs too many"));
  EXPECT_EQ(fault("N\n3,3\nC\n9\nR\n1,1\nT\n1,1\nM\n1,1,1\n1,1\n1,1,1\n"),
            "m:11: row 2 of the costs has 2 values; the size says 3");
  EXPECT_TRUE(fault("").starts_with("m:1: "));
  EXPECT_TRUE(fault("N\n1,1\nC\n5\nR\n1,1\nT\n1,1\n1,1").find("before the line M") != std::string::npos);
}

TEST(PursuitMap, SizesAreCheckedBeforeMemoryIsTaken) {
  EXPECT_TRUE(fault(test::replaced(small_pursuit, "3,2", "100000,100000")).find("the most") !=
              std::string::npos);
  EXPECT_TRUE(fault(test::replaced(small_pursuit, "3,2", "10000,10000")).find("cut short") !=
              std::string::npos);
  EXPECT_TRUE(fault(test::replaced(small_pursuit, "3,2", "100001,1")).starts_with("m:2: "));
}

TEST(PursuitMap, GzipAndTruncatedGzip) {
  const test::Folder folder;
  std::string noise;
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) noise += fmt::format("{},", rng.below(100));
  const std::string text = "N\n1,2001\nC\n9\nR\n1,1\nT\n1,1\nM\n" + noise + "1\n";
  const std::string path = (folder.path / "m.txt.gz").string();
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  ASSERT_TRUE(load_pursuit_map(path));
  std::string bytes = test::bytes_of(path);
  bytes.resize(bytes.size() / 2);
  const auto cut = load_pursuit_map(folder.write("cut.txt.gz", bytes));
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, FaultCode::bad_input);
  EXPECT_NE(cut.error().sentence.find("cut short"), std::string::npos) << cut.error().sentence;
  EXPECT_NE(cut.error().where.find("cut.txt.gz"), std::string::npos);
}

/// The same numbers by streams, without any of the reader's code.
PursuitProblem slowly(const std::string& path) {
  std::string text;
  gzFile file = gzopen(path.c_str(), "rb");
  char buffer[1 << 16];
  for (int got = 0; (got = gzread(file, buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(got));
  }
  gzclose(file);
  for (char& c : text) c = c == ',' ? ' ' : c;
  std::istringstream in(text);
  std::string letter;
  double x = 0, y = 0, c = 0;
  in >> letter >> x >> y >> letter >> c >> letter;
  auto costs = std::make_shared<CostGrid>(GridFrame{{0, 0}, 1.0, static_cast<int>(x), static_cast<int>(y)});
  PursuitProblem problem{nullptr, static_cast<std::uint32_t>(c), {}, {}};
  in >> x >> y >> letter;
  problem.start = {static_cast<int>(x) - 1, static_cast<int>(y) - 1};
  while (in >> letter && letter != "M") {
    in >> y;
    problem.target.push_back({std::stoi(letter) - 1, static_cast<int>(y) - 1});
  }
  for (int column = 0; column < costs->frame.width; ++column) {
    for (int row = 0; row < costs->frame.height; ++row) {
      in >> c;
      (*costs)[{column, row}] = static_cast<std::uint32_t>(c);
    }
  }
  EXPECT_TRUE(in);
  problem.costs = costs;
  return problem;
}

TEST(PursuitMap, PublishedFilesAsASlowTwinReadsThem) {
  const auto folder = test::data_folder() / "pursuit";
  OUTRIDER_NEEDS_DATA(folder);
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (!path.ends_with(".txt.gz")) continue;
    ++files;
    const auto problem = load_pursuit_map(path);
    ASSERT_TRUE(problem) << to_string(problem.error());
    const PursuitProblem twin = slowly(path);
    EXPECT_EQ(problem->costs->frame, twin.costs->frame);
    EXPECT_TRUE(problem->costs->cells == twin.costs->cells) << path;
    EXPECT_EQ(problem->threshold, twin.threshold);
    EXPECT_EQ(problem->start, twin.start);
    EXPECT_EQ(problem->target, twin.target);
  }
  EXPECT_GE(files, 11);
}

TEST(PursuitMap, SurvivesDamage) {
  Rng rng(2);
  for (int i = 0; i < 20'000; ++i) {
    const auto problem = pursuit_map_from_text(test::damaged(small_pursuit, rng), "m");
    if (!problem) {
      EXPECT_FALSE(problem.error().where.empty());
      continue;
    }
    EXPECT_TRUE(problem->costs->contains(problem->start));
    for (const Cell cell : problem->target) EXPECT_TRUE(problem->costs->contains(cell));
  }
}

}  // namespace
}  // namespace outrider
