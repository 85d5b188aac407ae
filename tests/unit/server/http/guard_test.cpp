#include "http/guard.hpp"

#include <gtest/gtest.h>

namespace outrider::server {
namespace {

Request request(const std::string& method, const std::string& host, const std::string& origin = {}) {
  Request made{method, "/api/v1/runs", {}, {{"host", host}}, {}};
  if (!origin.empty()) made.headers["origin"] = origin;
  return made;
}

int status(const Request& asked, const std::string& token = {}) {
  const auto refused = refusal(asked, token);
  return refused ? refused->status : 200;
}

TEST(Guard, HostsOfThisMachine) {
  for (const char* host :
       {"localhost", "localhost:1", "127.0.0.1:8080", "127.1.2.3", "[::1]:8080", "[::1]"}) {
    EXPECT_EQ(status(request("GET", host)), 200) << host;
  }
  for (const char* host :
       {"", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "192.168.1.1", "[::2]", "[",
        "::1:80", "127.0.0.1:", "127.0.0.1:80a", "localhost:80@evil.example", "127.0.0.1:80:80",
        "[::1].evil.example", "[::1]8080", "[::1"}) {
    EXPECT_EQ(status(request("GET", host)), 403) << host;
  }
}

TEST(Guard, OriginsOfWhatCosts) {
  const std::string host = "127.0.0.1:8080";
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "X"}) {
    EXPECT_EQ(status(request(method, host)), 200) << method;
    EXPECT_EQ(status(request(method, host, "http://127.0.0.1:8080")), 200) << method;
    for (const char* origin :
         {"null", "http://127.0.0.1:8081", "http://127.0.0.1:80800", "http://evil.example",
          "http://localhost:8080", "file://", "HTTP://127.0.0.1:8080"}) {
      EXPECT_EQ(status(request(method, host, origin)), 403) << method << origin;
    }
  }
  Request socket = request("GET", host, "http://evil.example");
  EXPECT_EQ(status(socket), 403) << "it reads files";
  socket.path = "/";
  EXPECT_EQ(status(socket), 200) << "a file of the page";
  socket.headers["upgrade"] = "websocket";
  EXPECT_EQ(status(socket), 403);
}

/// As browsers send it for images and links, which have no Origin.
TEST(Guard, SitesOfWhatCosts) {
  Request asked = request("GET", "127.0.0.1:8080");
  for (const char* site : {"same-origin", "none"}) {
    asked.headers["sec-fetch-site"] = site;
    EXPECT_EQ(status(asked), 200) << site;
  }
  for (const char* site : {"cross-site", "same-site"}) {
    asked.headers["sec-fetch-site"] = site;
    EXPECT_EQ(status(asked), 403) << site;
    asked.path = "/watch";
    EXPECT_EQ(status(asked), 200) << "a link to the page";
    asked.path = "/api/v1/files";
  }
  asked.headers["origin"] = "http://127.0.0.1:8080";
  EXPECT_EQ(status(asked), 200) << "the Origin says more";
}

TEST(Guard, WebSocketsOfThoseWhoWereGivenTheToken) {
  const std::string token = "0123456789abcdef";
  Request socket{"GET", "/", {}, {{"host", "robot.example"}, {"origin", "https://app.foxglove.dev"}}, {}};
  EXPECT_EQ(status(socket, token), 200) << "a page needs no token, and no origin";
  socket.headers["upgrade"] = "websocket";
  EXPECT_EQ(status(socket, token), 403);
  socket.query = "token=" + token;
  EXPECT_EQ(status(socket, token), 200);
  socket.headers.erase("origin");
  EXPECT_EQ(status(socket, token), 200);
  socket.query = {};
  EXPECT_EQ(status(socket, token), 401);
  Request saving = socket;
  saving.method = "PUT";
  saving.query = "token=" + token;
  saving.headers = {{"host", "robot.example"}, {"origin", "https://app.foxglove.dev"}};
  EXPECT_EQ(status(saving, token), 403) << "only a WebSocket";
}

TEST(Guard, Tokens) {
  const std::string token = "0123456789abcdef";
  Request asked = request("GET", "robot.example:8080");
  EXPECT_EQ(status(asked, token), 401);
  for (const char* wrong :
       {"", "0", "0123456789abcdeg", "0123456789abcdef0", "0123456789abcdef0123456789abcdef"}) {
    asked.headers["authorization"] = std::string("Bearer ").append(wrong);
    EXPECT_EQ(status(asked, token), 401) << wrong;
  }
  asked.headers["authorization"] = std::string("Bearer ").append(token);
  EXPECT_EQ(status(asked, token), 200);
  asked.headers.erase("authorization");
  asked.query = "a=1&token=0123456789%61bcdef";
  EXPECT_EQ(status(asked, token), 200);
  asked.query.clear();
  asked.path = "/";
  EXPECT_EQ(status(asked, token), 200) << "the page itself is no secret";
}

TEST(Guard, SecretsAreTheSameOrNot) {
  EXPECT_TRUE(same_secret("abc", "abc"));
  for (const char* other : {"", "ab", "abd", "abcd", "abcabc"})
    EXPECT_FALSE(same_secret(other, "abc")) << other;
  EXPECT_FALSE(same_secret("", ""));
}

TEST(Guard, RatesAreBounded) {
  RateLimit limit(10.0, 3.0);
  const RateLimit::Clock::time_point begin;
  const auto at = [&](int ms) { return begin + std::chrono::milliseconds(ms); };
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(limit.take(at(0)));
  EXPECT_FALSE(limit.take(at(0)));
  EXPECT_FALSE(limit.take(at(50)));
  EXPECT_TRUE(limit.take(at(150)));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(limit.take(at(60'000)));
  EXPECT_FALSE(limit.take(at(60'000)));
}

}  // namespace
}  // namespace outrider::server
