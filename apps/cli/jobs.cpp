#include "jobs.hpp"

namespace outrider::cli {

const std::vector<Job>& jobs() {
  static const std::vector<Job> all = {
      {"cover", "Pass over every spot of an area, in a guaranteed time.",
       "A key stands in a scenario file, at its top or in the section that the heading names; as a flag of\n"
       "`outrider cover` the key `width` is `--width` and the key `speed` of the section `pace` is\n"
       "`--pace-speed`. Flags win over the file."},
      {"drive", "Drive to waypoints by the tags in sight, or open loop by time.",
       "A key stands in a scenario file, at its top or in the section that the heading names; as a flag of\n"
       "`outrider drive` the key `loop` is `--loop` and the key `speed` of the section `follow` is\n"
       "`--follow-speed`. Flags win over the file."},
      {"explore", "Map an unknown world to the last reachable cell, then come home.",
       "A key stands in a scenario file, at its top or in the section that the heading names; as a flag of\n"
       "`outrider explore` the key `start` is `--start` and the key `strategy` of the section `explore` is\n"
       "`--explore-strategy`. Flags win over the file."},
      {"guard", "Hit every target in a yard with a ballistic water gun, soonest.",
       "A key stands in a scenario file, at its top or in the section that the heading names; as a flag the\n"
       "key `targets_block` is `--targets-block` and the key `radius` of the section `robot` is\n"
       "`--robot-radius`. Flags win over the file. [scenario.schema.json](scenario.schema.json) lets an "
       "editor\n"
       "check one."},
      {"plan", "Find a collision-free path for a disk robot.",
       "A key stands in a scenario file, which `outrider run` answers and the page writes. The flags of\n"
       "`outrider plan` have the same names, but that it takes the map without one, and that a radius which\n"
       "is not given depends there on the kind of map."},
      {"pursue", "Catch a moving target on a grid of costs, at the least cost.",
       "A key stands in a scenario file; as a flag of `outrider pursue` it has `--` in front. Flags win over "
       "the\n"
       "file."},
      {"slam", "Localise and map from a recorded log, or solve a pose graph.",
       "A key stands in a scenario file, at its top or in the section that the heading names; as a flag of\n"
       "`outrider slam` the key `truth` is `--truth` and the key `reach` of the section `laser` is\n"
       "`--laser-reach`. Flags win over the file."}};
  return all;
}

std::vector<OptionGroup> BlankScenarios::options(std::string_view job) {
  if (job == "guard") return describe(guard);
  if (job == "pursue") return describe(pursue);
  if (job == "cover") return describe(cover);
  if (job == "drive") return describe(drive);
  if (job == "explore") return describe(explore);
  if (job == "plan") return describe(plan);
  if (job == "slam") return describe(slam);
  return {};
}

}  // namespace outrider::cli
