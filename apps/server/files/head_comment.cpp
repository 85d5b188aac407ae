#include "files/head_comment.hpp"

#include "files/folder.hpp"
#include "outrider/core/text.hpp"

namespace outrider::server {

std::string head_comment(std::string_view yaml) {
  std::string text;
  while (!yaml.empty()) {
    std::string_view line = yaml.substr(0, yaml.find('\n'));
    yaml.remove_prefix(std::min(yaml.size(), line.size() + 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() && text.empty()) continue;
    if (!line.starts_with('#')) break;
    line.remove_prefix(1);
    if (line.starts_with(' ')) line.remove_prefix(1);
    if (line.empty() && !text.empty()) break;
    const bool command = line.starts_with(' ') || line.starts_with('\t');
    if (line.empty() || command || line == saved_here) continue;
    if (!is_printable(line)) break;
    if (text.empty() && line.size() > longest_head_comment) {  // cut between words
      return std::string(line.substr(0, line.substr(0, longest_head_comment - 3).rfind(' ') + 1)) + "...";
    }
    if (text.size() + line.size() + 1 > longest_head_comment) break;
    if (!text.empty()) text += ' ';
    text += line;
  }
  return text;
}

}  // namespace outrider::server
