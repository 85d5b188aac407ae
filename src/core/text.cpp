#include "outrider/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// Returns the number of bytes after the first byte of a UTF-8 character; 4 if no character begins with it.
std::size_t tail_length(unsigned lead) {
  if (lead < 0x80) return 0;
  if (lead >> 5 == 0x6) return 1;
  if (lead >> 4 == 0xE) return 2;
  return lead >> 3 == 0x1E ? 3 : 4;
}

/// Returns the length of the well-formed, printable character at the start of the text; 0 if there is none.
std::size_t character_length(std::string_view text) {
  constexpr unsigned least_by_tail[] = {0x20, 0x80, 0x800, 0x10000};  // below: control or overlong
  const unsigned lead = static_cast<unsigned char>(text[0]);
  const std::size_t tail = tail_length(lead);
  if (tail > 3 || text.size() <= tail) return 0;
  unsigned code = tail == 0 ? lead : lead & (0x3FU >> tail);
  for (const char c : text.substr(1, tail)) {
    const unsigned byte = static_cast<unsigned char>(c);
    if (byte >> 6 != 2) return 0;
    code = code << 6 | (byte & 0x3FU);
  }
  const bool surrogate = code >> 11 == 0x1B;
  const bool control = code >= 0x7F && code < 0xA0;
  return code >= least_by_tail[tail] && code <= 0x10FFFF && !surrogate && !control ? tail + 1 : 0;
}

}  // namespace

bool is_printable(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string printable(std::string_view text, std::string_view kept) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    std::size_t length = character_length(text);
    if (length == 0 && kept.find(text[0]) != std::string_view::npos) length = 1;
    if (length == 0) result += '?';
    result += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower_letter(c);
  return result;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(white_space), text.size()));
  return text.substr(0, text.find_last_not_of(white_space) + 1);
}

std::string markup_text(std::string_view text) {
  std::string safe;
  for (const char c : printable(text)) {
    switch (c) {
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '&': safe += "&amp;"; break;
      default: safe += c;
    }
  }
  return safe;
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "an unknown time";
  if (seconds < 0.995) return fmt::format("{:.2f} s", seconds);
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  if (seconds > 1e9) return fmt::format("{:.3g} s", seconds);
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  const long minutes = (whole + 30) / 60;
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace outrider
