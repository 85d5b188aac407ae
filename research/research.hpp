// What compares, proves or bounds, but runs no robot: reference methods beside those of the library. `make
// research` builds it into the tool; the library does not have it.
#pragma once

namespace outrider {

/// Adds the rows of research/ to the catalogues of the library. Once, before the first thread starts.
void add_research();

}  // namespace outrider
