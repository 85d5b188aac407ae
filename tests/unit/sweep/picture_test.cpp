#include "outrider/sweep/picture.hpp"

#include <regex>

#include "sweep_job.hpp"

namespace outrider {
namespace {

using SweepPicture = testing::SweepFolder;

std::ptrdiff_t count_of(const std::string& text, const std::string& pattern) {
  const std::regex wanted(pattern);
  return std::distance(std::sregex_iterator(text.begin(), text.end(), wanted), std::sregex_iterator());
}

TEST_F(SweepPicture, ShowsRatesAHeatMapAndHistograms) {
  const Sweep all = sweep({.runs = 200, .seed = 2, .vary = {"x=uniform(0,10)", "mode=a,b"}});
  ASSERT_FALSE(table(all, "out").empty());
  ChunkReader chunks(all, path("out"));
  const auto summary = summarise(chunks);
  ASSERT_TRUE(summary);
  const auto svg = sweep_picture(chunks, *summary);
  ASSERT_TRUE(svg) << to_string(svg.error());
  for (const char* title : {">done, by x<", ">done, by mode<", ">across: x, up: mode<", ">y<", ">twice<"}) {
    EXPECT_NE(svg->find(title), std::string::npos) << title;
  }
  EXPECT_EQ(count_of(*svg, "<circle"), 10) << "8 bins and 2 modes";
  EXPECT_EQ(count_of(*svg, "stroke=\"#fff\""), 16) << "cells of the heat map";
  EXPECT_EQ(count_of(*svg, "nan|inf"), 0);
  EXPECT_EQ(count_of(*svg, "<script|href"), 0);
  const std::string page = sweep_page("a <b>", *svg, "1 < 2\n  3\n");
  EXPECT_NE(page.find("<title>a &lt;b&gt;</title>"), std::string::npos);
  EXPECT_NE(page.find("<pre>1 &lt; 2\n  3\n</pre>"), std::string::npos);
}

/// Sweeps with nothing to show still have a picture.
TEST_F(SweepPicture, HoldsWhereNothingVaries) {
  int count = 0;
  for (const SweepRequest& request : {SweepRequest{.runs = 1}, SweepRequest{.runs = 3, .vary = {"x=0,0.1"}},
                                      SweepRequest{.runs = 3, .compare = {"x=0,1"}}}) {
    const Sweep all = sweep(request);
    const std::string folder = "out" + std::to_string(count++);
    ASSERT_FALSE(table(all, folder).empty());
    ChunkReader chunks(all, path(folder));
    const auto summary = summarise(chunks);
    ASSERT_TRUE(summary);
    const auto svg = sweep_picture(chunks, *summary);
    ASSERT_TRUE(svg) << to_string(svg.error());
    EXPECT_EQ(count_of(*svg, "nan|inf"), 0);
  }
}

}  // namespace
}  // namespace outrider
