#include "outrider/log/log_reader.hpp"

#include "formats.hpp"

namespace outrider {

LogOpened open_log(const std::string& path, const LogSelection& /*selection*/) {
  return bad_input("it is not a log: neither MCAP, nor a ROS 1 bag, nor a ROS 2 db3", path);
}

}  // namespace outrider
