#include <gtest/gtest.h>

#include <string>

#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "sample_report.hpp"

namespace outrider {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

const std::string viewer =
    "<!doctype html><title>@TITLE@</title><script type=\"application/json\" id=\"report\">@REPORT@</script>"
    "<script>show()</script>";

// What a browser takes for the content of the element with the report.
std::string embedded(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"report\">";
  const std::size_t start = page.find(open) + open.size();
  return page.substr(start, page.find("</script", start) - start);
}

TEST(ReplayPage, HoldsTheWholeReport) {
  const PageReport report = test::sample_report();
  const auto back = report_from_json(embedded(to_html(report, viewer)));
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(to_json(*back), to_json(report));
}

TEST(ReplayPage, NamesCannotBreakOut) {
  const std::string plain = to_html(test::sample_report(), viewer);
  for (const std::string name :
       {"</script><script>alert(1)</script>", "<!--<script>", "</title><img onerror=alert(1)>",
        "@TITLE@ @REPORT@", "\"'`&<>", "]]>", "\xE2\x80\xA8", "\xff\xfe</script>"}) {
    PageReport report = test::sample_report();
    report.world_name = report.job = report.reason = name;
    report.targets[0].name = report.solids[2].name = report.shots[0].contact = name;
    report.metrics.emplace_back(name, 1.0);
    report.settings.emplace_back(name, name);
    report.warnings.push_back(name);
    const std::string page = to_html(report, viewer);
    EXPECT_EQ(count(page, "<script"), count(plain, "<script")) << name;
    EXPECT_EQ(count(page, "</script"), count(plain, "</script")) << name;
    EXPECT_EQ(count(page, "<!--"), count(plain, "<!--")) << name;
    EXPECT_EQ(count(page, "<img"), 0U) << name;
    EXPECT_EQ(count(page, "</title>"), 1U) << name;
    const auto back = report_from_json(embedded(page));
    ASSERT_TRUE(back) << name;
    EXPECT_EQ(to_json(*back), to_json(report)) << name;
  }
}

TEST(ReplayPage, FillsEachMarkerOnce) {
  PageReport report = test::sample_report();
  report.world_name = "@REPORT@";
  const std::string page = to_html(report, viewer);
  EXPECT_TRUE(page.starts_with("<!doctype html><title>guard: @REPORT@</title>"));
  EXPECT_TRUE(page.ends_with("}</script><script>show()</script>") ||
              page.ends_with("}\n</script><script>show()</script>"));
}

TEST(ReplayPage, IsTheSameTwice) {
  EXPECT_EQ(to_html(test::sample_report(), viewer), to_html(test::sample_report(), viewer));
  EXPECT_FALSE(to_html(PageReport{}, viewer).empty());
}

}  // namespace
}  // namespace outrider
