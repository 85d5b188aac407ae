#include "page.hpp"

namespace outrider::page {

std::span<const File> files() { return {}; }

std::string_view viewer() { return {}; }

}  // namespace outrider::page
