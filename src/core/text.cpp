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

struct Character {
  std::size_t length = 1;  ///< in bytes; 1 if none is well-formed
  bool shown = false;
};

/// Returns true for marks and brackets that turn the direction of the text after them, and for ends of lines.
bool turns_text(unsigned code) {
  return code == 0x61C || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

/// Returns the character at the start of the text, which is not empty.
Character first_character(std::string_view text) {
  constexpr unsigned least_by_tail[] = {0, 0x80, 0x800, 0x10000};  // below: in too many bytes
  const unsigned lead = static_cast<unsigned char>(text[0]);
  const std::size_t tail = tail_length(lead);
  if (tail > 3 || text.size() <= tail) return {};
  unsigned code = tail == 0 ? lead : lead & (0x3FU >> tail);
  for (const char c : text.substr(1, tail)) {
    const unsigned byte = static_cast<unsigned char>(c);
    if (byte >> 6 != 2) return {};
    code = code << 6 | (byte & 0x3FU);
  }
  const bool surrogate = code >> 11 == 0x1B;
  const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  if (code < least_by_tail[tail] || code > 0x10FFFF || surrogate) return {};
  return {tail + 1, !control && !turns_text(code)};
}

}  // namespace

bool is_printable(std::string_view text) {
  while (!text.empty()) {
    const Character character = first_character(text);
    if (!character.shown) return false;
    text.remove_prefix(character.length);
  }
  return true;
}

std::string printable(std::string_view text, std::string_view kept) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto [length, shown] = first_character(text);
    result += shown || kept.find(text[0]) != kept.npos ? text.substr(0, length) : "?";
    text.remove_prefix(length);
  }
  return result;
}

std::string excerpt(std::string_view text, std::size_t most) {
  std::size_t end = 0;
  while (end < text.size()) {
    const std::size_t length = first_character(text.substr(end)).length;
    if (end + length > most) return printable(text.substr(0, end)) + "...";
    end += length;
  }
  return printable(text);
}

std::string short_number(double value) {
  constexpr int digits = 9, least_decimals = 3, most_decimals = 12;
  const double size = std::abs(value);
  if (!(size < 1e15)) return fmt::format("{:.6g}", value);
  if (size < 0.5e-12) return "0";
  const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
  const double scale = std::pow(10.0, std::clamp(digits - before, least_decimals, most_decimals));
  return fmt::format("{}", std::round(value * scale) / scale);
}

std::string place_text(double x, double y) {
  return fmt::format("({}, {})", short_number(x), short_number(y));
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
