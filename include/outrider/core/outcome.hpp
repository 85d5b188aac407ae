// Outcome<T>: a value, or a Fault that says in one sentence what went wrong and where.
//
// Every function of Outrider that can fail on its input returns an Outcome. Exceptions are only for broken
// invariants, that is, for bugs. Thread rule: plain values, no shared state.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace outrider {

enum class FaultCode {
  start_blocked,     ///< the start collides with an obstacle
  goal_blocked,      ///< the goal collides with an obstacle
  outside_map,       ///< the start or the goal lies outside the known world
  no_path,           ///< proven: no path connects the start and the goal
  no_shot,           ///< of all flights of the stated resolution none hits the target
  budget_exhausted,  ///< the budget of expansions or of wall time ended first
  cancelled,         ///< the caller's stop token was raised
  bad_input,         ///< a file, key or value is wrong; the sentence names the remedy
  cannot_write,      ///< the system failed to write a file, for instance on a full disk
};

/// Returns the name of the code as used in reports, e.g. "start_blocked".
std::string_view to_string(FaultCode code);

struct Fault {
  FaultCode code = FaultCode::bad_input;
  std::string sentence;  ///< one sentence for a person, with the value and the remedy
  std::string where;     ///< file:line, scenario key or flag; empty if the sentence says enough
};

/// Returns true if it answers what was asked: there is no path or no shot, or the search had no more budget.
[[nodiscard]] bool is_answer(const Fault& fault);

/// Returns "where: sentence", the form in which a fault is shown.
std::string to_string(const Fault& fault);

template <class T>
class [[nodiscard]] Outcome : public tl::expected<T, Fault> {
 public:
  using tl::expected<T, Fault>::expected;
};

using Status = Outcome<void>;

/// Makes a fault, for any function that returns an Outcome: `return fault(FaultCode::no_path, "...")`.
inline tl::unexpected<Fault> fault(FaultCode code, std::string sentence, std::string where = {}) {
  return tl::unexpected<Fault>(Fault{code, std::move(sentence), std::move(where)});
}
inline tl::unexpected<Fault> bad_input(std::string sentence, std::string where = {}) {
  return fault(FaultCode::bad_input, std::move(sentence), std::move(where));
}
/// Makes a fault from that of a failed outcome, to return it as an outcome of another type.
template <class T>
tl::unexpected<Fault> pass_on(Outcome<T>& outcome) {
  return tl::unexpected<Fault>(std::move(outcome.error()));
}
template <class T>
tl::unexpected<Fault> pass_on(const Outcome<T>& outcome) {
  return tl::unexpected<Fault>(outcome.error());
}

}  // namespace outrider
