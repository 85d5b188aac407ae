#include "http/compression.hpp"

#include "app_fixture.hpp"
#include "http/gunzip.hpp"

namespace outrider::server {
namespace {

std::string header(const Response& response, const std::string& name) {
  const std::map<std::string, std::string> headers(response.headers.begin(), response.headers.end());
  return headers.contains(name) ? headers.at(name) : "";
}

TEST(Compression, GzipIsAcceptedAsTheHeaderSays) {
  for (const char* yes : {"gzip", "br, gzip", "GZIP", "x-gzip", "deflate;q=0.5,gzip;q=1.0", "*",
                          "identity, *;q=0.1", " gzip ; q=0.001"})
    EXPECT_TRUE(accepts_gzip(yes)) << yes;
  for (const char* no : {"", "identity", "br", "gzip;q=0", "gzip; q=0.000", "*;q=0", "gzip;q=0, *", "notgzip",
                         ",,;", "gzip;q=x"})
    EXPECT_FALSE(accepts_gzip(no)) << no;
}

TEST(Compression, BytesComeBack) {
  std::string mixed(300'000, '\0');
  std::uint32_t state = 1;
  for (char& c : mixed) c = static_cast<char>((state = state * 1664525U + 1013904223U) >> 24U);
  for (const std::string& bytes : {std::string(), std::string("a"), std::string(1'000'000, 'x'), mixed})
    EXPECT_EQ(gunzipped(gzipped(bytes)), bytes);
}

TEST_F(AppTest, LongAnswersAreCompressedForThoseWhoAcceptIt) {
  const std::string text = "# " + std::string(5000, 'x') + "\njob: guard\n";
  write("long.yaml", text);
  const Response packed = ask("GET", "/api/v1/files/long.yaml", {}, {{"accept-encoding", "gzip"}});
  EXPECT_EQ(header(packed, "Content-Encoding"), "gzip");
  EXPECT_EQ(header(packed, "Vary"), "Accept-Encoding");
  EXPECT_EQ(header(packed, "Accept-Ranges"), "") << "parts are those of the file";
  EXPECT_LT(packed.body.size(), 200U);
  EXPECT_EQ(gunzipped(packed.body), text);
  const Response plain = ask("GET", "/api/v1/files/long.yaml");
  EXPECT_EQ(header(plain, "Content-Encoding"), "");
  EXPECT_EQ(header(plain, "Vary"), "Accept-Encoding");
  EXPECT_EQ(header(plain, "Accept-Ranges"), "bytes");
  EXPECT_EQ(body_of(plain), text);
  const Response part =
      ask("GET", "/api/v1/files/long.yaml", {}, {{"accept-encoding", "gzip"}, {"range", "bytes=0-1999"}});
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(header(part, "Content-Encoding"), "");
  EXPECT_EQ(part.file->part(part.range->first, part.range->count), text.substr(0, 2000));
  const Response catalogue = ask("GET", "/api/v1/catalogue", {}, {{"accept-encoding", "gzip"}});
  EXPECT_EQ(gunzipped(catalogue.body), ask("GET", "/api/v1/catalogue").body);
}

TEST_F(AppTest, ShortAnswersAndCompressedFilesStayAsTheyAre) {
  write("short.yaml", "job: guard\n");
  for (const char* name : {"run.mcap", "a.png", "a.log.gz"}) write(name, std::string(5000, 'x'));
  for (const char* path :
       {"files/short.yaml", "files/run.mcap", "files/a.png", "files/a.log.gz", "version"}) {
    const Response response = ask("GET", std::string("/api/v1/") + path, {}, {{"accept-encoding", "gzip"}});
    EXPECT_EQ(header(response, "Content-Encoding"), "") << path;
    EXPECT_EQ(response.status, 200);
  }
}

TEST_F(AppTest, WithoutMemoryForItAnAnswerIsNotCompressed) {
  write("long.yaml", std::string(5000, '#'));
  const auto all = app().shared().answers.take(app().shared().answers.all());
  ASSERT_TRUE(all);
  const Response response = ask("GET", "/api/v1/files/long.yaml", {}, {{"accept-encoding", "gzip"}});
  EXPECT_EQ(header(response, "Content-Encoding"), "");
  EXPECT_EQ(body_of(response).size(), 5000U);
}

}  // namespace
}  // namespace outrider::server
