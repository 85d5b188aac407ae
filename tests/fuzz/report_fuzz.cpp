// Reports: what loads is written and read back the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "outrider/report/json.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto report = outrider::report_from_json(input);
  if (!report) {
    if (report.error().sentence.empty()) std::abort();
    return 0;
  }
  const std::string text = outrider::to_json(*report);
  const auto again = outrider::report_from_json(text);
  if (!again || outrider::to_json(*again) != text) std::abort();
  return 0;
}
