#include "sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/polyline.hpp"

namespace outrider::picture {
namespace {

constexpr std::string_view line_sample = "<path d=\"M2 7H28\"/>", area_sample = "<path d=\"M2 1H28V13H2Z\"/>";

/// Returns one of 11 opacities. Even what is palest can be seen.
double opacity_of(double share) {
  return std::isfinite(share) ? std::ceil(12.0 * std::clamp(share, 0.1, 1.0)) / 12.0 : 1.0;
}

std::string path_of(const std::vector<Vec2>& points_px) {
  std::string path;
  for (const Vec2 point : points_px)
    path += fmt::format("{}{:.4g} {:.4g}", path.empty() ? "M" : " ", point.x, point.y);
  return path;
}

}  // namespace

/// Returns the place on the sheet in whole details, so that shapes that cannot be told apart are equal.
Vec2 Sheet::at(Vec2 world) {
  if (finite(world)) seen_.include(world);
  const auto rounded = [&](double px) { return detail_px_ * std::round(px / detail_px_); };
  return {rounded(px_per_m_ * (world.x - box_.low.x)), rounded(px_per_m_ * (box_.high.y - world.y))};
}

void Sheet::add(Kind kind, const Details& details, std::string_view sample, const std::string& tag) {
  const auto [first, last] = std::ranges::equal_range(layers_, kind.row, {}, &Layer::row);
  auto layer = std::ranges::find(first, last, details.words, &Layer::words);
  if (layer == last) {
    const Look& look = looks[kind.row];
    const auto turn = static_cast<std::size_t>(last - first);
    const bool is_coloured = look.css.find("currentColor") != std::string_view::npos;
    // Later colours are thinner, so that equal lines stay visible.
    const double width_px = is_coloured ? std::max(1.2, 4.0 - 0.4 * static_cast<double>(turn)) : 1.0;
    const auto group = fmt::format("<g class=\"{}\" color=\"{}\" stroke-width=\"{:.1f}\">", look.kind,
                                   palette[turn % palette.size()], width_px);
    layer = layers_.insert(last, Layer{kind.row, details.words, group, std::string(sample)});
  }
  const std::string width = details.width_m > 0.0
                                ? fmt::format(" style=\"stroke-width:{:.1f}px\"", details.width_m * px_per_m_)
                                : "";
  layer->shapes.insert(fmt::format("<{}{} opacity=\"{:.2g}\"/>\n", tag, width, opacity_of(details.share)));
  ++layer->size;
}

void Sheet::line(Kind kind, std::span<const Vec2> points, const Details& details) {
  std::string path;
  std::vector<Vec2> part;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    if (i < points.size() && finite(points[i])) {
      part.push_back(at(points[i]));
      continue;
    }
    if (part.size() > 1) path += path_of(simplified(part, detail_px_));
    part.clear();
  }
  if (!path.empty()) add(kind, details, line_sample, fmt::format("path d=\"{}\"", path));
}

void Sheet::area(Kind kind, const std::vector<std::vector<Vec2>>& outlines, const Details& details) {
  std::string path;
  for (const std::vector<Vec2>& outline : outlines) {
    std::vector<Vec2> ring;
    for (const Vec2 corner : outline) ring.push_back(at(corner));
    if (ring.size() < 3 || !std::ranges::all_of(ring, [](Vec2 corner) { return finite(corner); })) continue;
    ring.push_back(ring.front());
    path += path_of(simplified(ring, detail_px_)) + "Z";
  }
  if (!path.empty()) add(kind, details, area_sample, fmt::format("path d=\"{}\"", path));
}

void Sheet::mark(Kind kind, const Pose2& pose, const std::string& name) {
  if (!finite(pose)) return;
  const Vec2 place = at(pose.position);
  const std::string symbol = fmt::format("use href=\"#{}\"", looks[kind.row].kind);
  add(kind, {}, fmt::format("<{} x=\"15\" y=\"7\"/>", symbol),
      fmt::format("{} transform=\"translate({:.4g} {:.4g}) rotate({:.0f})\"", symbol, place.x, place.y,
                  -degrees(pose.heading_rad)));
  if (name.empty()) return;
  const double length_px = 10.0 + 7.0 * static_cast<double>(name.size());
  const bool fits = place.x + length_px < px_per_m_ * box_.size().x;
  for (const bool right : {fits, !fits}) {
    const double x = place.x + (right ? 10.0 : -10.0), middle = place.x + (right ? 0.5 : -0.5) * length_px;
    const auto text = fmt::format("<text class=\"name\"{} x=\"{:.4g}\" y=\"{:.4g}\">{}</text>\n",
                                  right ? "" : " text-anchor=\"end\"", x, place.y + 4.0, markup_text(name));
    if (names_.emplace(std::pair(std::lround(middle / 60.0), std::lround(place.y / 16.0)), text).second)
      return;
  }
}

void Sheet::cells(Kind kind, const Cells& cells, double low, double high, const std::string& words) {
  const auto& [origin, cell_m, columns, rows, values] = cells;
  const auto corner = [&](std::size_t x, std::size_t y) {
    return at(origin * (cell_m * Vec2{static_cast<double>(x), static_cast<double>(y)}));
  };
  const Vec2 start = corner(0, 0), right = corner(columns, 0) - start, up = corner(0, rows) - start;
  const double least_block = std::ceil(3.0 * detail_px_ / (px_per_m_ * cell_m));
  if (values.size() != columns * rows || !finite(corner(columns, rows)) || !(least_block > 0.0)) return;
  const auto block = static_cast<std::size_t>(std::min(least_block, 1e6));
  const auto opacity = [&](double value) {
    return value >= low && value <= high ? opacity_of(low < high ? (value - low) / (high - low) : 1.0) : 0.0;
  };
  std::map<double, std::string> paths;  // by opacity; a block of cells has that of the darkest
  for (std::size_t y = 0; y < rows; y += block) {
    const std::size_t top = std::min(y + block, rows);
    std::vector<double> row((columns + block - 1) / block, 0.0);
    for (std::size_t i = y * columns; i < top * columns; ++i)
      row[i % columns / block] = std::max(row[i % columns / block], opacity(values[i]));
    for (std::size_t first = 0, last = 0; first < row.size(); first = last) {
      while (last < row.size() && row[last] == row[first]) ++last;
      const std::size_t x = first * block, width = std::min(last * block, columns) - x;
      paths[row[first]] += fmt::format("M{} {}h{}v{}h-{}z", x, y, width, top - y, width);
    }
  }
  paths.erase(0.0);
  const double x_scale = 1.0 / static_cast<double>(columns), y_scale = 1.0 / static_cast<double>(rows);
  const std::string frame =
      fmt::format("matrix({:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g})", x_scale * right.x, x_scale * right.y,
                  y_scale * up.x, y_scale * up.y, start.x, start.y);
  for (const auto& [share, path] : paths)
    add(kind, {words, share}, area_sample,
        fmt::format("path transform=\"{}\" shape-rendering=\"crispEdges\" d=\"{}\"", frame, path));
}

std::string Sheet::drawing() const {
  std::string text;
  for (const Layer& layer : layers_) {
    text += layer.group + "\n";
    for (const std::string& shape : layer.shapes) text += shape;
    text += "</g>\n";
  }
  for (const auto& [piece, name] : names_) text += name;
  return text;
}

/// Returns the sample of a layer for the legend, over what shows through it.
std::string Sheet::sample_of(const Layer& layer) const {
  std::string under;
  for (const std::string_view kind : looks[layer.row].below) {
    const auto below =
        std::ranges::find_if(layers_, [&](const Layer& other) { return looks[other.row].kind == kind; });
    if (below == layers_.end()) continue;
    under = sample_of(*below);
    break;
  }
  // The ends of a wide line would stand out beside the field below it.
  const std::string ends = under.empty() ? "" : "<g stroke-linecap=\"butt\">";
  return under + layer.group + ends + layer.sample + (under.empty() ? "</g>" : "</g></g>");
}

std::string Sheet::legend(double left_px, double top_px, double width_px, double& height_px) const {
  const std::size_t columns = width_px < 600.0 ? 1 : 3;
  std::set<std::string> written;
  std::string text;
  for (const Layer& layer : layers_) {
    const auto words =
        layer.words.empty() ? fmt::format(fmt::runtime(looks[layer.row].words), layer.size) : layer.words;
    const std::size_t index = written.size();
    if (words.empty() || !written.insert(words).second) continue;
    text += fmt::format(
        "<g transform=\"translate({:.4g} {:.4g})\">{}<text x=\"38\" y=\"12\">{}</text></g>\n",
        left_px + width_px * static_cast<double>(index % columns) / static_cast<double>(columns),
        top_px + 22.0 * static_cast<double>(index / columns), sample_of(layer), markup_text(words));
  }
  height_px = 22.0 * static_cast<double>((written.size() + columns - 1) / columns);
  return text;
}

}  // namespace outrider::picture
