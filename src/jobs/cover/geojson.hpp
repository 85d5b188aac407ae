// The output files of a coverage run: GeoJSON in the coordinates of the area's file, and the track in metres.
#pragma once

#include <string>

#include "outrider/io/map/area_frame.hpp"
#include "outrider/jobs/cover/report.hpp"

namespace outrider::cover {

/// The area, its reach, and what is covered, missed and covered more than once, planned and driven.
std::string areas_geojson(const CoverRun& run, const AreaFrame& frame);

/// The track as lines, one for each lap, lane and move; arcs as chords that turn by 4 degrees.
std::string track_geojson(const CoverRun& run, const AreaFrame& frame);

/// The track as pieces in local metres, with where these are, and what was driven.
std::string track_json(const CoverRun& run, const AreaFrame& frame);

}  // namespace outrider::cover
