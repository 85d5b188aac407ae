// A look: a drive reads the tags in its newest image.
#pragma once

#include "outrider/jobs/drive/mission/mission.hpp"

namespace outrider {

/// Corrects the belief by the tags of the newest image, if it is recent enough and new. Returns true if the
/// image corrected it.
bool look(DriveMission& mission, const Observation& seen);

/// Returns true if the belief rests on the start, or on a pose that two different tags agree on.
bool is_trusted(const DriveMission& mission);

/// Returns the one tag on which the belief rests while nothing corroborates it; null if the belief is
/// trusted.
const TagSupport* lone_support(const DriveMission& mission);

/// Returns the tags without which nothing puts the robot where it believes to stand, to within `part` of the
/// tolerance; nothing if no tags do that well enough (tag_votes.hpp). An empty set: the stop does not depend
/// on any one tag.
std::optional<std::set<int>> indispensable_tags(const DriveMission& mission, double part = 1.0);

/// Returns true if the belief is trusted, and the stop depends on no one tag unless the belief was sharp all
/// the way since the last stop. `part`: see above.
bool is_corroborated(const DriveMission& mission, double part = 1.0);

/// Lets the way to the next waypoint begin where the robot believes to be.
void begin_leg_anew(DriveMission& mission);

/// Replaces the belief by the pose that the tags in sight agree on, if they do. Returns true if it did.
bool relocalise(DriveMission& mission);

/// Returns a sentence about a tag that often contradicted the others; empty if there is none.
std::string tag_doubt(const DriveMission& mission);

}  // namespace outrider
