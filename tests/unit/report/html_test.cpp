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

// What a browser takes for the content of the element with the report.
std::string embedded(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"report\">";
  const std::size_t start = page.find(open) + open.size();
  return page.substr(start, page.find("</script", start) - start);
}

TEST(ReplayPage, HoldsTheWholeReport) {
  const Report report = test::sample_report();
  const auto back = report_from_json(embedded(to_html(report)));
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(to_json(*back), to_json(report));
}

TEST(ReplayPage, NeedsNothingElse) {
  const std::string page = to_html(test::sample_report());
  EXPECT_EQ(
      count(page, "@TITLE@") + count(page, "@STYLE@") + count(page, "@REPORT@") + count(page, "@SCRIPT@"),
      0U);
  for (const std::string part : {"src=", "url(", "@import", "fetch(", "https://", "innerHTML", "eval("}) {
    EXPECT_EQ(count(page, part), 0U) << part;
  }
  EXPECT_EQ(count(page, "http://"), count(page, "http://www.w3.org/2000/svg"));  // a name, not a place
}

TEST(ReplayPage, NamesCannotBreakOut) {
  const std::string plain = to_html(test::sample_report());
  for (const std::string name :
       {"</script><script>alert(1)</script>", "<!--<script>", "</title><img onerror=alert(1)>",
        "@SCRIPT@ @REPORT@", "\"'`&<>", "]]>", "\xE2\x80\xA8", "\xff\xfe</script>"}) {
    Report report = test::sample_report();
    report.world_name = report.job = report.reason = name;
    report.targets[0].name = report.solids[2].name = report.shots[0].contact = name;
    report.metrics.emplace_back(name, 1.0);
    report.settings.emplace_back(name, name);
    report.warnings.push_back(name);
    const std::string page = to_html(report);
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

TEST(ReplayPage, TakesAPageOfAnotherMake) {
  Report report = test::sample_report();
  report.world_name = "@REPORT@ </script>";
  const std::string page = to_html(
      report, "<title>@TITLE@</title><script type=\"application/json\" id=\"report\">@REPORT@</script>");
  EXPECT_TRUE(page.starts_with("<title>guard: @REPORT@ &lt;/script"));
  EXPECT_EQ(count(page, "</script"), 1U);
  const auto back = report_from_json(embedded(page));
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(to_json(*back), to_json(report));
  EXPECT_EQ(to_html(report, {}), to_html(report));
}

TEST(ReplayPage, IsTheSameTwice) {
  EXPECT_EQ(to_html(test::sample_report()), to_html(test::sample_report()));
  EXPECT_FALSE(to_html(Report{}).empty());
}

}  // namespace
}  // namespace outrider
