// Reference methods beside those of the library: they compare, prove or bound, but run no robot. `make
// research` builds them and outrider-research, the tool with them; the library does not have them.
#pragma once

#include <vector>

#include "outrider/job/job.hpp"

namespace outrider {

/// Adds the rows of research/ to the catalogues of the library. Once, before the first thread starts.
void add_research();

/// Returns the jobs of the library, of which guard has the section `pddl` as well.
std::vector<Job> research_jobs();

}  // namespace outrider
