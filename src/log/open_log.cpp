#include <algorithm>

#include "byte_source.hpp"
#include "formats.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {
namespace {

Outcome<std::string> first_bytes(const std::string& path) {
  constexpr std::uint64_t enough = 16;
  const auto source = open_file_source(path);
  if (!source) return tl::unexpected<Fault>(source.error());
  return (*source)->read(0, std::min(enough, (*source)->size()));
}

}  // namespace

LogOpened open_log(const std::string& path, const LogSelection& selection) {
  auto start = first_bytes(path);
  if (!start) return pass_on(start);
  if (is_mcap(*start)) return open_mcap(path, selection);
  return bad_input("it is not a log: neither MCAP, nor a ROS 1 bag, nor a ROS 2 db3", path);
}

}  // namespace outrider
