#include <gtest/gtest.h>

#include <string>

#include "outrider/core/base64.hpp"
#include "page.hpp"

namespace outrider::page {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

const std::string open_log = "<script type=\"application/octet-stream;base64\" id=\"log\">";
const std::string empty =
    "<!doctype html><title>@TITLE@</title>" + open_log + "@LOG@</script><script>show()</script>";

// Returns what a browser takes for the content of the element with the log.
std::string embedded(const std::string& page) {
  const std::size_t start = page.find(open_log) + open_log.size();
  return page.substr(start, page.find("</script", start) - start);
}

std::string all_bytes() {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i * i);
  return bytes;
}

TEST(ReplayPage, HoldsTheWholeLog) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{999}}) {
    const std::string log = all_bytes().substr(0, length);
    EXPECT_EQ(base64_decoded(embedded(page_of_run("guard: yard", log, empty))), log);
  }
}

TEST(ReplayPage, TheTitleCannotBreakOut) {
  const std::string plain = page_of_run("guard: yard", all_bytes(), empty);
  for (const std::string name :
       {"</title><script>alert(1)</script>", "<!--<script>", "</title><img onerror=alert(1)>",
        "@TITLE@ @LOG@", "\"'`&<>", "]]>", "\xE2\x80\xA8", "\xff\xfe</script>"}) {
    const std::string page = page_of_run(name, all_bytes(), empty);
    EXPECT_EQ(count(page, "<script"), count(plain, "<script")) << name;
    EXPECT_EQ(count(page, "</script"), count(plain, "</script")) << name;
    EXPECT_EQ(count(page, "<!--"), 0U) << name;
    EXPECT_EQ(count(page, "<img"), 0U) << name;
    EXPECT_EQ(count(page, "</title>"), 1U) << name;
    EXPECT_EQ(base64_decoded(embedded(page)), all_bytes()) << name;
  }
}

TEST(ReplayPage, TheLogCannotBreakOut) {
  const std::string page = page_of_run("t", "</script><script>alert(1)</script>@LOG@", empty);
  EXPECT_EQ(count(page, "</script"), 2U);
  EXPECT_EQ(count(page, "@LOG@"), 0U);
}

TEST(ReplayPage, FillsEachMarkerOnce) {
  const std::string page = page_of_run("guard: @LOG@", "log", empty);
  EXPECT_TRUE(page.starts_with("<!doctype html><title>guard: @LOG@</title>"));
  EXPECT_TRUE(page.ends_with("bG9n</script><script>show()</script>"));
}

}  // namespace
}  // namespace outrider::page
