#include "live_report.hpp"

#include <fmt/format.h>

#include "outrider/report/json.hpp"

namespace outrider::cli {
namespace {

constexpr std::chrono::milliseconds period{200};
constexpr std::size_t longest_line = std::size_t{4} << 20U;

}  // namespace

void LiveReport::append(std::size_t, std::int64_t time_ns, std::string_view) {
  if (time_ns > 0 && std::chrono::steady_clock::now() >= next_) send();  // the scene is whole then
}

void LiveReport::finish(const Log& log) {
  log_ = &log;
  if (!log.channels().empty()) send();
  log_ = nullptr;
}

void LiveReport::send() {
  const PageReport news = growth_.delta(page_report({}, *log_));
  std::string line = to_json_line(news);
  if (line.size() > longest_line) {
    line = fmt::format(R"({{"omitted":"{}","bytes":{},"most_bytes":{}}})",
                       news.job.empty() ? "news" : "scene", line.size(), longest_line);
  }
  watcher_.send(std::move(line));
  next_ = std::chrono::steady_clock::now() + period;
}

}  // namespace outrider::cli
