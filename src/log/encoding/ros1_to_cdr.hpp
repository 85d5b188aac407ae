// Ros1ToCdr: messages of ROS 1 as CDR, by the definition that their channel carries. Their type need not be
// known.
//
// The two formats differ in alignment, the zero at the end of strings, the "seq" of a header, the byte of a
// message without fields, and the names of fields, which are in lower case in ROS 2.
#pragma once

#include <string>
#include <string_view>

#include "encoding/definition.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider {

class Ros1ToCdr {
 public:
  /// Fault: bad_input, if the schema of the channel is none or not complete.
  static Outcome<Ros1ToCdr> of(const Channel& channel);

  /// Returns the channel of the converted messages.
  [[nodiscard]] const Channel& channel() const { return channel_; }
  /// Fault: bad_input with the topic, if the bytes do not agree with the definition.
  [[nodiscard]] Outcome<std::string> convert(std::string_view ros1) const;

 private:
  Channel channel_;
  Definitions definitions_;
  std::string type_;  ///< short name
};

}  // namespace outrider
