#include "live_report.hpp"

#include <fmt/format.h>

#include "outrider/report/json.hpp"

namespace outrider::cli {
namespace {

constexpr std::chrono::milliseconds period{200};
constexpr std::size_t longest_line = std::size_t{4} << 20U;

}  // namespace

bool LiveReport::wants() { return std::chrono::steady_clock::now() >= next_; }

void LiveReport::see(const Report& so_far) {
  const Report news = growth_.delta(so_far);
  std::string line = to_json_line(news);
  if (line.size() > longest_line) {
    line = fmt::format(R"({{"omitted":"{}","bytes":{},"most_bytes":{}}})",
                       news.job.empty() ? "news" : "scene", line.size(), longest_line);
  }
  watcher_.send(std::move(line));
  next_ = std::chrono::steady_clock::now() + period;
}

}  // namespace outrider::cli
