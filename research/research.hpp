// Reference methods beside those of the library: they compare, prove or bound, but run no robot. `make
// research` builds them into the tool; the library does not have them.
#pragma once

namespace outrider {

/// Adds the rows of research/ to the catalogues of the library. Once, before the first thread starts.
void add_research();

}  // namespace outrider
