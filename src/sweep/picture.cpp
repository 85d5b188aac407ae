#include "outrider/sweep/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "axis.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/sweep/columns.hpp"

namespace outrider {
namespace {

constexpr double width_px = 980.0, pad_px = 28.0, panel_px = 210.0, head_px = 56.0;
constexpr int columns_of_panels = 3;
constexpr std::size_t most_metrics = 12, most_axes = 3, histogram_bins = 30, most_numbers = 16'000'000;
constexpr std::array<const char*, 2> side_colours = {"#0a6cc4", "#c54c06"};
constexpr std::size_t most_label_bytes = 12;
constexpr double letter_px = 6.6;  // width of a letter, about

/// A panel: its title above, and room for a drawing.
struct Frame {
  double left, top, width, height;
  [[nodiscard]] double bottom() const { return top + height; }
};

std::string text_at(double x, double y, const std::string& text, const char* look = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}{}>{}</text>\n", x, y, *look == '\0' ? "" : " ", look,
                     markup_text(text));
}

std::string box(double x, double y, double width, double height, const std::string& fill) {
  return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n", x, y, width,
                     height, fill);
}

std::string short_label(const std::string& label) {
  return label.size() <= most_label_bytes ? label
                                          : printable(label.substr(0, most_label_bytes - 1)) + "\u2026";
}

/// Returns which labels have room along an axis: every so many, with `step_px` between neighbours.
std::size_t label_stride(const std::vector<std::string>& labels, double step_px) {
  std::size_t longest = 1;
  for (const std::string& label : labels) longest = std::max(longest, short_label(label).size());
  return static_cast<std::size_t>(std::ceil((static_cast<double>(longest) + 1.0) * letter_px / step_px));
}

std::string axes_of(const Frame& frame) {
  return fmt::format("<path fill=\"none\" stroke=\"#a9b4bd\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n",
                     frame.left, frame.top, frame.bottom(), frame.left + frame.width);
}

/// The rates of done of the runs at each place, a row for each side.
std::vector<Rate> rates_of(const Sweep& sweep, const std::vector<bool>& done, const Axis& axis,
                           std::uint64_t side) {
  std::vector<Rate> rates(axis.labels.size());
  for (std::uint64_t run = side; run < sweep.total; run += sweep.sides()) {
    if (axis.place_of[run] >= rates.size()) continue;
    Rate& rate = rates[axis.place_of[run]];
    ++rate.count;
    if (done[run]) ++rate.hits;
  }
  for (Rate& rate : rates) {
    if (rate.count > 0) rate.interval = wilson_interval(rate.hits, rate.count);
  }
  return rates;
}

std::string rate_panel(const Sweep& sweep, const std::vector<bool>& done, const Axis& axis,
                       const Frame& frame) {
  std::string svg =
      text_at(frame.left, frame.top - 10.0, "done, by " + axis.key, "class=\"head\"") + axes_of(frame);
  for (const int percent : {0, 50, 100}) {
    const double y = frame.bottom() - frame.height * percent / 100.0;
    svg += text_at(frame.left - 6.0, y + 4.0, fmt::format("{} %", percent),
                   "class=\"soft\" text-anchor=\"end\"");
  }
  const double step = frame.width / static_cast<double>(axis.labels.size());
  for (std::uint64_t side = 0; side < sweep.sides(); ++side) {
    const auto rates = rates_of(sweep, done, axis, side);
    for (std::size_t i = 0; i < rates.size(); ++i) {
      if (rates[i].count == 0) continue;
      const double x = frame.left + step * (static_cast<double>(i) + 0.5) +
                       (sweep.sides() == 2 ? (side == 0 ? -4.0 : 4.0) : 0.0);
      const auto y = [&](double rate) { return frame.bottom() - frame.height * rate; };
      svg += fmt::format(
          "<path stroke=\"{0}\" stroke-width=\"1.6\" d=\"M{1:.1f} {2:.1f}V{3:.1f}\"/><circle cx=\"{1:.1f}\" "
          "cy=\"{4:.1f}\" r=\"3.4\" fill=\"{0}\"/>\n",
          side_colours[side], x, y(rates[i].interval.low), y(rates[i].interval.high),
          y(static_cast<double>(rates[i].hits) / static_cast<double>(rates[i].count)));
    }
  }
  const std::size_t every = label_stride(axis.labels, step);
  for (std::size_t i = 0; i < axis.labels.size(); i += every) {
    svg += text_at(frame.left + step * (static_cast<double>(i) + 0.5), frame.bottom() + 16.0,
                   short_label(axis.labels[i]), "class=\"soft\" text-anchor=\"middle\"");
  }
  return svg;
}

/// Returns a colour between orange, where nothing is done, and blue, where all is.
std::string heat_colour(double rate) {
  const auto mixed = [&](double none, double half, double all) {
    return static_cast<int>(std::lround(rate < 0.5 ? none + (half - none) * 2.0 * rate
                                                   : half + (all - half) * (2.0 * rate - 1.0)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(197, 243, 10), mixed(76, 243, 108), mixed(6, 240, 196));
}

std::string heat_panel(const std::vector<bool>& done, const Axis& x, const Axis& y, const Frame& frame) {
  std::string svg = text_at(frame.left, frame.top - 10.0, "done, by both keys", "class=\"head\"");
  svg += text_at(frame.left, frame.bottom() + 32.0, fmt::format("across: {}, up: {}", x.key, y.key),
                 "class=\"soft\"");
  std::vector<Rate> rates(x.labels.size() * y.labels.size());
  for (std::size_t run = 0; run < done.size(); ++run) {
    if (x.place_of[run] >= x.labels.size() || y.place_of[run] >= y.labels.size()) continue;
    Rate& rate = rates[y.place_of[run] * x.labels.size() + x.place_of[run]];
    ++rate.count;
    if (done[run]) ++rate.hits;
  }
  const double wide = frame.width / static_cast<double>(x.labels.size());
  const double high = frame.height / static_cast<double>(y.labels.size());
  const bool labelled = wide >= 34.0 && high >= 16.0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double left = frame.left + wide * static_cast<double>(i % x.labels.size());
    const double top = frame.bottom() - high * static_cast<double>(i / x.labels.size() + 1);
    if (rates[i].count == 0) {
      svg += box(left, top, wide, high, "fill=\"#fff\" stroke=\"#d5dce1\"");
      continue;
    }
    const double rate = static_cast<double>(rates[i].hits) / static_cast<double>(rates[i].count);
    svg += box(left, top, wide, high, fmt::format("fill=\"{}\" stroke=\"#fff\"", heat_colour(rate)));
    if (!labelled) continue;
    svg += text_at(
        left + 0.5 * wide, top + 0.5 * high + 4.0, fmt::format("{:.0f} %", 100.0 * rate),
        rate > 0.75 || rate < 0.2 ? "text-anchor=\"middle\" style=\"fill:#fff\"" : "text-anchor=\"middle\"");
  }
  for (std::size_t i = 0; i < x.labels.size(); i += label_stride(x.labels, wide)) {
    svg += text_at(frame.left + wide * (static_cast<double>(i) + 0.5), frame.bottom() + 16.0,
                   short_label(x.labels[i]), "class=\"soft\" text-anchor=\"middle\"");
  }
  for (std::size_t i = 0; i < y.labels.size(); i += 1 + y.labels.size() / 13) {
    svg += text_at(frame.left - 6.0, frame.bottom() - high * (static_cast<double>(i) + 0.5) + 4.0,
                   short_label(y.labels[i]), "class=\"soft\" text-anchor=\"end\"");
  }
  return svg;
}

/// The range that the histograms of both sides share.
std::pair<double, double> range_of(const SweepSummary& summary, std::size_t metric) {
  double low = INFINITY, high = -INFINITY;
  for (const RunsSummary& side : summary.sides) {
    if (side.metrics[metric].count == 0) continue;
    low = std::min(low, side.metrics[metric].low);
    high = std::max(high, side.metrics[metric].high);
  }
  return {low, high};
}

std::string histogram_panel(const Sweep& sweep, const SweepSummary& summary, const Column& column,
                            std::size_t metric, const Frame& frame) {
  const auto [low, high] = range_of(summary, metric);
  std::vector<std::array<double, 2>> counts(histogram_bins);
  double most = 0.0;
  for (std::size_t run = 0; run < column.values.size(); ++run) {
    if (!std::isfinite(column.values[run])) continue;
    const double place = (column.values[run] - low) / (high - low) * static_cast<double>(histogram_bins);
    double& count =
        counts[std::min(static_cast<std::size_t>(place), histogram_bins - 1)][run % sweep.sides()];
    most = std::max(most, ++count);
  }
  std::string svg = text_at(frame.left, frame.top - 10.0, column.name, "class=\"head\"") + axes_of(frame);
  const double wide = frame.width / static_cast<double>(histogram_bins);
  for (std::uint64_t side = 0; side < sweep.sides(); ++side) {
    for (std::size_t i = 0; i < histogram_bins; ++i) {
      const double tall = frame.height * counts[i][side] / most;
      if (tall <= 0.0) continue;
      svg += box(frame.left + wide * static_cast<double>(i), frame.bottom() - tall, wide, tall,
                 fmt::format("fill=\"{}\" fill-opacity=\"{}\"", side_colours[side],
                             sweep.sides() == 2 ? 0.5 : 0.75));
    }
    const MetricSummary& one = summary.sides[side].metrics[metric];
    if (one.count == 0) continue;
    const double x = frame.left + frame.width * (one.quantiles[2].value - low) / (high - low);
    svg += fmt::format(
        "<path stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"5 3\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n",
        side_colours[side], x, frame.top, frame.bottom());
  }
  svg += text_at(frame.left, frame.bottom() + 16.0, fmt::format("{:.4g}", low), "class=\"soft\"");
  svg += text_at(frame.left + frame.width, frame.bottom() + 16.0, fmt::format("{:.4g}", high),
                 "class=\"soft\" text-anchor=\"end\"");
  return svg;
}

/// Places panels in rows of three.
class Panels {
 public:
  Frame next() {
    const int column = count_ % columns_of_panels, row = count_ / columns_of_panels;
    ++count_;
    const double wide = (width_px - pad_px) / columns_of_panels;
    return {pad_px + 26.0 + wide * column, head_px + 28.0 + panel_px * row, wide - 66.0, panel_px - 76.0};
  }
  [[nodiscard]] double bottom() const {
    return head_px + panel_px * ((count_ + columns_of_panels - 1) / columns_of_panels);
  }

 private:
  int count_ = 0;
};

/// Returns the metrics that differ between runs, and fit into memory.
std::vector<std::size_t> shown_metrics(const Sweep& sweep, const SweepSummary& summary) {
  const std::size_t most =
      std::min<std::size_t>(most_metrics, std::max<std::size_t>(1, most_numbers / sweep.total));
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < summary.sides[0].metrics.size() && shown.size() < most; ++i) {
    const auto [low, high] = range_of(summary, i);
    if (high > low && std::isfinite(high - low)) shown.push_back(i);
  }
  return shown;
}

std::string heading(const Sweep& sweep, const SweepSummary& summary) {
  std::string text = fmt::format("{}: {} runs", summary.job, summary.runs);
  std::string svg = fmt::format("<title>{0}</title>\n<text x=\"{1}\" y=\"32\" class=\"title\">{0}</text>\n",
                                markup_text(text), pad_px);
  svg += text_at(pad_px, 50.0, "dashes: median", "class=\"soft\"");
  double x = pad_px + 260.0;
  for (std::uint64_t side = 0; side < sweep.sides(); ++side) {
    const Rate& rate = summary.sides[side].done;
    std::string label = sweep.sides() == 2 ? (side == 0 ? "a" : "b") : "all";
    for (const auto& [key, value] : summary.sides[side].values) label = key + "=" + value;
    label += fmt::format(
        ": {:.1f} % done",
        rate.count == 0 ? 0.0 : 100.0 * static_cast<double>(rate.hits) / static_cast<double>(rate.count));
    svg += box(x, 21.0, 12.0, 12.0, fmt::format("fill=\"{}\"", side_colours[side]));
    svg += text_at(x + 18.0, 32.0, printable(label));
    x += 48.0 + letter_px * static_cast<double>(label.size());
  }
  return svg;
}

}  // namespace

Outcome<std::string> sweep_picture(ChunkReader& chunks, const SweepSummary& summary) {
  const Sweep& sweep = chunks.sweep();
  const auto shown = shown_metrics(sweep, summary);
  std::vector<std::string> names = shown_keys(sweep, most_axes);
  const std::size_t keys = names.size();
  for (const std::size_t i : shown) names.push_back(summary.sides[0].metrics[i].name);
  const auto columns = read_columns(chunks, names);
  if (!columns) return pass_on(columns);
  std::vector<Axis> axes;
  for (std::size_t i = 0; i < keys; ++i) axes.push_back(axis_of(sweep, (*columns)[i]));
  std::erase_if(axes, [](const Axis& axis) { return axis.labels.empty(); });
  Panels panels;
  std::string body = heading(sweep, summary);
  for (const Axis& axis : axes) body += rate_panel(sweep, summary.done, axis, panels.next());
  if (axes.size() > 1) body += heat_panel(summary.done, axes[0], axes[1], panels.next());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    body += histogram_panel(sweep, summary, (*columns)[keys + i], shown[i], panels.next());
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\" role=\"img\">\n<style>\ntext{{font:12px system-ui,-apple-system,\"Segoe UI\",\"Noto "
      "Sans\",\"DejaVu Sans\",sans-serif;fill:#15212b}}\n.title{{font-size:19px;font-weight:650}}\n"
      ".head{{font-weight:600}}\n.soft{{fill:#566470;font-size:11px}}\n</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{2}</svg>\n",
      width_px, panels.bottom() + 10.0, body);
}

std::string sweep_page(const std::string& title, const std::string& picture, const std::string& text) {
  std::string lines;
  for (std::string_view rest = text; !rest.empty();) lines += markup_text(take_line(rest)) + "\n";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>{}</title>\n<style>\nbody{{margin:24px auto;max-width:1010px;"
      "font:14px system-ui,sans-serif;color:#15212b}}\nsvg{{max-width:100%;height:auto}}\n"
      "pre{{overflow-x:auto;font-size:12.5px;line-height:1.4}}\n</style>\n{}<pre>{}</pre>\n</html>\n",
      markup_text(title), picture, lines);
}

}  // namespace outrider
