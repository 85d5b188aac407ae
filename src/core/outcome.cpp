#include "outrider/core/outcome.hpp"

namespace outrider {

std::string_view to_string(FaultCode code) {
  switch (code) {
    case FaultCode::start_blocked: return "start_blocked";
    case FaultCode::goal_blocked: return "goal_blocked";
    case FaultCode::outside_map: return "outside_map";
    case FaultCode::no_path: return "no_path";
    case FaultCode::no_shot: return "no_shot";
    case FaultCode::budget_exhausted: return "budget_exhausted";
    case FaultCode::cancelled: return "cancelled";
    case FaultCode::bad_input: return "bad_input";
    case FaultCode::cannot_write: return "cannot_write";
  }
  return "unknown";
}

bool is_answer(const Fault& fault) {
  return fault.code == FaultCode::no_path || fault.code == FaultCode::no_shot ||
         fault.code == FaultCode::budget_exhausted;
}

std::string to_string(const Fault& fault) {
  return fault.where.empty() ? fault.sentence : fault.where + ": " + fault.sentence;
}

}  // namespace outrider
