// Families of libapriltag, owned.
#pragma once

#include <apriltag/apriltag.h>

#include <memory>

#include "outrider/estimate/tag_family.hpp"

namespace outrider {

using TagLibraryFamily = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

TagLibraryFamily make_family(TagFamily family);

}  // namespace outrider
