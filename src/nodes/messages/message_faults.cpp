#include "outrider/nodes/messages/message_faults.hpp"

namespace outrider {

std::vector<Option> describe(MessageFaults& faults) {
  return {{"loss", "", 0.0, 1.0, "fraction of the messages that are lost", &faults.loss},
          {"delay", "s", 0.0, 60.0, "by which the others come late", &faults.delay_s}};
}

}  // namespace outrider
