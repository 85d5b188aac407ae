#include "app_fixture.hpp"

namespace outrider::server {
namespace {

// RFC 9110, section 14.
TEST_F(AppTest, PartsOfFilesAreServed) {
  write("a.txt", "0123456789");
  struct Case {
    const char* range;
    int status;
    const char* content_range;
    const char* body;
  };
  const Case cases[] = {{"bytes=0-0", 206, "bytes 0-0/10", "0"},
                        {"bytes=2-4", 206, "bytes 2-4/10", "234"},
                        {"bytes=7-", 206, "bytes 7-9/10", "789"},
                        {"bytes=7-100", 206, "bytes 7-9/10", "789"},
                        {"bytes=-3", 206, "bytes 7-9/10", "789"},
                        {"bytes=-30", 206, "bytes 0-9/10", "0123456789"},
                        {"bytes=10-", 416, "bytes */10", ""},
                        {"bytes=-0", 416, "bytes */10", ""},
                        {"bytes=4-2", 200, "", "0123456789"},
                        {"bytes=0-1,3-4", 200, "", "0123456789"},
                        {"bytes=x-", 200, "", "0123456789"},
                        {"bytes=-", 200, "", "0123456789"},
                        {"bytes=99999999999999999999-", 200, "", "0123456789"},
                        {"lines=0-1", 200, "", "0123456789"},
                        {"", 200, "", "0123456789"}};
  for (const Case& one : cases) {
    const Response response = ask("GET", "/api/v1/files/a.txt", {}, {{"range", one.range}});
    EXPECT_EQ(response.status, one.status) << one.range;
    const std::map<std::string, std::string> headers(response.headers.begin(), response.headers.end());
    const auto found = headers.find("Content-Range");
    EXPECT_EQ(found == headers.end() ? "" : found->second, one.content_range) << one.range;
    if (one.status == 416) continue;
    EXPECT_EQ(headers.at("Accept-Ranges"), "bytes");
    const ByteRange range = response.range.value_or(ByteRange{0, response.file->bytes()});
    EXPECT_EQ(response.file->part(range.first, range.count), one.body) << one.range;
  }
  EXPECT_EQ(ask("GET", "/api/v1/files/a.txt", {}, {{"range", "bytes=0-1"}, {"if-range", "\"tag\""}}).status,
            200);
  EXPECT_EQ(ask("HEAD", "/api/v1/files/a.txt", {}, {{"range", "bytes=0-1"}}).status, 200);
}

TEST_F(AppTest, LogsAreServedWhateverTheirLength) {
  write("a.mcap", "");
  write("a.bin", "");
  const std::uintmax_t long_file = std::uintmax_t{3} << 30U;  // a hole, which takes no place on the disk
  std::filesystem::resize_file(path("a.mcap"), long_file);
  std::filesystem::resize_file(path("a.bin"), long_file);
  EXPECT_EQ(ask("GET", "/api/v1/files/a.bin").status, 413);
  EXPECT_EQ(ask("GET", "/api/v1/files/a.mcap").status, 200);
  const Response end = ask("GET", "/api/v1/files/a.mcap", {}, {{"range", "bytes=-8"}});
  EXPECT_EQ(end.range->first, long_file - 8);
}

}  // namespace
}  // namespace outrider::server
