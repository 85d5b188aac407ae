#include "tag_library.hpp"

#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <cstdlib>

namespace outrider {

TagLibraryFamily make_family(TagFamily family) {
  switch (family) {
    case TagFamily::tag16h5: return {tag16h5_create(), &tag16h5_destroy};
    case TagFamily::tag25h9: return {tag25h9_create(), &tag25h9_destroy};
    case TagFamily::tag36h10: return {tag36h10_create(), &tag36h10_destroy};
    case TagFamily::tag36h11: return {tag36h11_create(), &tag36h11_destroy};
    case TagFamily::tag_circle21h7: return {tagCircle21h7_create(), &tagCircle21h7_destroy};
    case TagFamily::tag_circle49h12: return {tagCircle49h12_create(), &tagCircle49h12_destroy};
    case TagFamily::tag_custom48h12: return {tagCustom48h12_create(), &tagCustom48h12_destroy};
    case TagFamily::tag_standard41h12: return {tagStandard41h12_create(), &tagStandard41h12_destroy};
    case TagFamily::tag_standard52h13: return {tagStandard52h13_create(), &tagStandard52h13_destroy};
  }
  std::abort();
}

}  // namespace outrider
