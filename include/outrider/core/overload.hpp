// Overload: combines lambdas, one for each type of a std::variant, into one visitor.
#pragma once

namespace outrider {

template <class... Visitors>
struct Overload : Visitors... {
  using Visitors::operator()...;
};

}  // namespace outrider
