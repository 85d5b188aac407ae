// Looks: a row for each kind of thing in a plan view, from below to above, with all that makes its
// appearance.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace outrider::picture {

struct Look {
  std::string_view kind;
  std::string_view words;        ///< line in the legend; empty: none. "{}" is how many there are
  std::string_view css;          ///< "currentColor" is another colour for each line in the legend
  std::string_view symbol = {};  ///< of marks: path data around the place, for a heading to the right
  /// Kinds one of which lies below it and shows through it: the legend draws the first that the picture has.
  std::array<std::string_view, 2> below = {};
};

inline constexpr std::string_view dot = "M-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0z",
                                  disk = "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z",
                                  pin = "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0zM4 0H12",
                                  cross = "M-4-4L4 4M4-4L-4 4", square = "M-7-7H7V7H-7z";

inline constexpr auto looks = std::to_array<Look>({
    {"unknown", "not mapped", "fill:#e4e8eb"},
    {"free", "mapped: free", "fill:#fff"},
    {"mapped", "mapped: occupied", "fill:#4d5c68"},
    {"cost", "", "fill:#a07a40"},
    {"in_range", "", "fill:#7d68b0"},
    {"expanded", "expanded; the later, the darker", "fill:#d97a2b"},
    {"close", "no room for the robot's centre", "fill:#f3ded3;stroke:#f3ded3"},
    {"occupied", "occupied", "fill:#4d5c68"},
    {"beyond", "out of reach", "fill:#d5dce1"},
    {"reach", "not covered", "fill:#f8efd9"},
    {"covered", "covered", "stroke:#00785a;stroke-opacity:.25;stroke-width:12", {}, {"reach"}},
    {"swath", "covered by the bar", "fill:#00785a;fill-opacity:.25", {}, {"reach"}},
    {"overlap", "covered more than once", "fill:#00785a;fill-opacity:.3", {}, {"covered", "swath"}},
    {"missed", "missed", "fill:#c54c06"},
    {"border", "area to cover", "stroke:#15212b;stroke-width:1.2"},
    {"steep", "too steep to drive on", "fill:#c54c06;fill-opacity:.13"},
    {"contour", "", "stroke:#5f7d46"},
    {"solid", "solid; the taller, the darker", "fill:#4d5c68;stroke:#4d5c68;stroke-width:.6"},
    {"wall", "wall", "fill:#4d5c68"},
    {"truth", "true solid", "fill:#15212b;fill-opacity:.14"},
    {"overhead", "overhead, not in the way",
     "fill:#566470;fill-opacity:.16;stroke:#566470;stroke-dasharray:4 3"},
    {"keep_out", "keep-out zone",
     "fill:#c51b1b;fill-opacity:.16;fill-rule:evenodd;stroke:#c51b1b;stroke-width:1.2"},
    {"slow", "slow zone", "fill:#e6a800;fill-opacity:.16;fill-rule:evenodd;stroke:#e6a800;stroke-width:1.2"},
    {"body", "robot on its way",
     "fill:#0a6cc4;fill-opacity:.05;stroke:#0a6cc4;stroke-opacity:.4;stroke-width:.8"},
    {"axis", "medial axis", "stroke:#566470;stroke-width:.9;stroke-opacity:.75"},
    {"bar", "the bar in the end", "stroke:#15212b;stroke-width:1.4"},
    {"plan", "planned path", "stroke:#a9cdea;stroke-width:5;stroke-opacity:.75"},
    {"coloured", "", "stroke:currentColor"},
    {"odometry", "odometry alone", "stroke:#566470;stroke-opacity:.6"},
    {"reference", "reference", "stroke:#00785a;stroke-width:1.8;stroke-dasharray:1.5 4"},
    {"pursued", "target", "stroke:#c54c06;stroke-width:2.4"},
    {"belief", "believed track", "stroke:#97237f;stroke-width:1.5;stroke-dasharray:5 3"},
    {"doubt", "its uncertainty, 2\u03c3", "stroke:#97237f;stroke-opacity:.7;fill:#97237f;fill-opacity:.08"},
    {"track", "", "stroke:#f0a52b;stroke-width:2.3"},
    {"later", "", "stroke:#5a2a00;stroke-width:2.3;stroke-linecap:butt"},
    {"arrow", "", "stroke:#15212b;stroke-width:1.4", "M-6-4L0 0L-6 4"},
    {"loop", "loop closed ({})", "stroke:#0a6cc4;stroke-opacity:.8"},
    {"start", "robot at the start", "stroke:#6b4000;stroke-width:2;fill:#fff", pin},
    {"end", "robot at the end", "stroke:#6b4000;stroke-width:2;fill:#f0a52b", pin},
    {"ellipse", "", "stroke:#00785a;fill:#00785a;fill-opacity:.15"},
    {"landmark", "landmark, 2\u03c3 ({})", "fill:#00785a", dot},
    {"true", "true place of a landmark", "stroke:#15212b;stroke-width:1.6", cross},
    {"goal", "goal ({})", "stroke:#0a6cc4;stroke-width:1.6", disk},
    {"refusal", "frontier left unexplored ({})", "stroke:#7c4d9e;stroke-width:2", cross},
    {"water", "water", "fill:#0a6cc4", square},
    {"charge", "charge", "fill:#e69f00;stroke:#fff", "M-3-5H3V5H-3z"},
    {"tag", "tag, and where it faces", "fill:#15212b;stroke:#15212b;stroke-width:2", "M-4-4H4V4H-4zM4 0H11"},
    {"passed", "waypoint to pass by", "fill:#0a6cc4", dot},
    {"reached", "waypoint, reached", "fill:#fff;stroke:#0a6cc4;stroke-width:2", pin},
    {"unreached", "waypoint, not reached", "fill:#fff;stroke:#c54c06;stroke-width:2", pin},
    {"hit", "shot that hit ({})", "stroke:#0a6cc4;stroke-width:1.2"},
    {"miss", "shot that missed ({})", "stroke:#c54c06;stroke-width:1.2;stroke-dasharray:4 3"},
    {"walk", "way of a target", "stroke:#566470;stroke-dasharray:2 3"},
    {"waiting", "target waiting ({})", "fill:#fff;stroke:#566470;stroke-width:2", disk},
    {"outside", "target outside ({})", "fill:#fff;stroke:#566470;stroke-width:1", disk},
    {"done", "target reached ({})", "fill:#fff;stroke:#00785a;stroke-width:2",
     "M-6 0a6 6 0 1 0 12 0a6 6 0 1 0-12 0zM-3 0L-.5 2.5L3-2.5"},
    {"failed", "target failed ({})", "fill:#fff;stroke:#c54c06;stroke-width:2",
     "M0-8L8 0L0 8L-8 0zM-2-2L2 2M2-2L-2 2"},
    {"unreachable", "target unreachable ({})", "fill:#fff;stroke:#7c4d9e;stroke-width:2",
     "M-6-6H6V6H-6zM-3 0H3"},
    {"grid", "", "stroke:#15212b;stroke-opacity:.07"},
});

/// Colours that people with every kind of colour vision tell apart. Source: Okabe and Ito, Color Universal
/// Design, 2008, and Tol, Colour schemes, 2021.
inline constexpr std::array<const char*, 10> palette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                        "#332288", "#e69f00", "#56b4e9", "#882255",
                                                        "#117733", "#999933"};

/// The number of a row. A kind that has no row does not compile.
struct Kind {
  std::size_t row = 0;
  consteval Kind(const char* kind) {
    while (looks.at(row).kind != kind) ++row;
  }
};

}  // namespace outrider::picture
