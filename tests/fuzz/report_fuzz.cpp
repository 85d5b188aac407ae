// Reports: what loads is written and read back the same, and can be drawn; its names never become markup.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"

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
  if (outrider::to_json_line(*report).find('\n') != std::string::npos) std::abort();

  const std::string page = outrider::to_html(*report, "<title>@TITLE@</title><script>@REPORT@</script>");
  const std::size_t script = page.find("</script");
  if (script == std::string::npos || page.find("</script", script + 1) != std::string::npos) std::abort();
  if (page.find("<script") != page.rfind("<script")) std::abort();
  return 0;
}
