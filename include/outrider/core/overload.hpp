// Overload: one visitor for a std::variant out of a lambda for each of its types.
#pragma once

namespace outrider {

template <class... Visitors>
struct Overload : Visitors... {
  using Visitors::operator()...;
};

}  // namespace outrider
