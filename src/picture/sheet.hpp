// Sheet: a plan view while it is drawn. Places are in the frame of the map, in metres; what has a number that
// is not finite is left out.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "looks.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/log/log.hpp"

namespace outrider::picture {

/// Values of cells, row by row from the lowest corner.
struct Cells {
  Pose2 origin;
  double cell_m = 1.0;
  std::size_t columns = 0, rows = 0;
  std::vector<double> values = {};
};

/// Properties that may differ between drawings of one kind.
struct Details {
  std::string words = {};  ///< line of the legend, instead of that of the kind
  double share = 1.0;      ///< how dark it is, 0 to 1
  double width_m = 0.0;    ///< of the line; 0: as the kind has it
};

class Sheet {
 public:
  /// Shows what is in `box`. Things smaller than `detail_px` are left out, and things that look the same are
  /// drawn once.
  Sheet(const Box2& box, double px_per_m, double detail_px)
      : box_(box), px_per_m_(px_per_m), detail_px_(detail_px) {}

  void line(Kind kind, std::span<const Vec2> points, const Details& details = {});
  /// Draws what lies within outlines; those that run clockwise are holes.
  void area(Kind kind, const std::vector<std::vector<Vec2>>& outlines, const Details& details = {});
  void mark(Kind kind, const Pose2& pose, const std::string& name = {});
  /// Draws the cells with values from `low`, pale, to `high`, dark.
  void cells(Kind kind, const Cells& cells, double low, double high, const std::string& words = {});

  /// Returns the box of everything that was drawn, m.
  [[nodiscard]] const Box2& seen() const { return seen_; }
  [[nodiscard]] std::string drawing() const;
  /// Returns the legend in columns below `top_px`, and sets its height.
  [[nodiscard]] std::string legend(double left_px, double top_px, double width_px, double& height_px) const;

 private:
  /// The shapes of a kind that have the same words.
  struct Layer {
    std::size_t row;
    std::string words;
    std::string group, sample;  ///< tag of the group, and a shape for the legend
    std::set<std::string> shapes = {};
    std::size_t size = 0;  ///< number of shapes, with those that look the same
  };

  Vec2 at(Vec2 world);
  [[nodiscard]] std::string sample_of(const Layer& layer) const;
  void add(Kind kind, const Details& details, std::string_view sample, const std::string& shape);

  Box2 box_, seen_;
  double px_per_m_, detail_px_;
  std::vector<Layer> layers_;                           ///< in the order of their rows
  std::map<std::pair<long, long>, std::string> names_;  ///< one in each piece of the sheet
};

/// Draw what the channels of a log show: the ground that the robot found or was given, and what happened on
/// it.
void draw_ground(Sheet& sheet, const Log& log);
void draw_events(Sheet& sheet, const Log& log);

}  // namespace outrider::picture
