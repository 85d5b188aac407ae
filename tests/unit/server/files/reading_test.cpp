#include "files/reading.hpp"

#include <atomic>
#include <thread>

#include "app_fixture.hpp"

namespace outrider::server {
namespace {

/// However long that takes: a busy machine is no reason to refuse. Only a number of them waits.
TEST_F(AppTest, QuestionsWaitForThoseBeforeThem) {
  write_tool("until [ -e go ]; do sleep 0.01; done\necho '{}'\n");
  const Folder folder = *Folder::open(home_.string());
  const ReadFiles read = reading_in_a_child({.tool = settings_.runs.tool, .at_once = 1, .waiting = 1});
  std::atomic<int> answered = 0, refused = 0;
  {
    std::vector<std::jthread> askers;
    for (int i = 0; i < 5; ++i) {
      askers.emplace_back([&] {
        const auto answer = read(folder, {{"map", "a.map"}}, {});
        EXPECT_TRUE(answer || error_response(answer.error()).status == 503);
        ++(answer ? answered : refused);
      });
    }
    for (int i = 0; i < 3000 && refused < 3; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(refused, 3);
    EXPECT_EQ(answered, 0);
    write("go", "");
  }
  EXPECT_EQ(answered, 2);
}

/// The limits are told apart, and each by its remedy.
TEST_F(AppTest, AQuestionThatTakesTooMuchIsRefused) {
  const Folder folder = *Folder::open(home_.string());
  const auto says = [&](const std::string& script) {
    write_tool(script);
    const auto answer = reading_in_a_child({.tool = settings_.runs.tool, .limit = std::chrono::seconds(1)})(
        folder, {{"map", "a.map"}}, {});
    return answer ? "" : answer.error().sentence;
  };
  EXPECT_EQ(says("sleep 1.2\necho '{}'\n"), "") << "it waited, as for a processor that others use";
  EXPECT_EQ(says("while :; do :; done\n").substr(0, 46), "reading it takes more than 1 s of a processor,");
  EXPECT_EQ(says("kill -9 $$\n").substr(0, 43), "reading it takes more than 1024 MiB of memo");
}

}  // namespace
}  // namespace outrider::server
