#include "live_report.hpp"

#include "outrider/report/json.hpp"

namespace outrider::cli {
namespace {

constexpr std::chrono::milliseconds period{200};
constexpr std::size_t longest_line = std::size_t{4} << 20U;

}  // namespace

bool LiveReport::wants() { return std::chrono::steady_clock::now() >= next_; }

void LiveReport::see(const Report& so_far) {
  std::string line = to_json_line(growth_.news(so_far));
  if (line.size() <= longest_line) watcher_.tell(std::move(line));
  next_ = std::chrono::steady_clock::now() + period;
}

}  // namespace outrider::cli
