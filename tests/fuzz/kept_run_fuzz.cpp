// The state of a kept run: what is read comes back the same when it is written and read again.
#include "runs/kept_runs.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "files/head_comment.hpp"
#include "fuzz_entry.hpp"
#include "http/message.hpp"

extern "C" int FUZZ_ENTRY(kept_run)(const std::uint8_t* data, std::size_t size) {
  namespace server = outrider::server;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  if (server::head_comment(input).size() > server::longest_head_comment) std::abort();
  const auto state = server::parse_json(input, "state.json");
  outrider::Outcome<server::KeptRun> run = outrider::bad_input("");
  if (state) run = server::kept_run_from_json(*state);
  if (!run) return 0;
  const std::string text = server::text_of(server::state_json(*run));
  const auto again = server::parse_json(text, "state.json");
  outrider::Outcome<server::KeptRun> same = outrider::bad_input("");
  if (again) same = server::kept_run_from_json(*again);
  if (!same || server::text_of(server::state_json(*same)) != text) std::abort();
  return 0;
}
