#include "supply_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "outrider/core/units.hpp"

namespace outrider::tour {
namespace {

class Builder {
 public:
  explicit Builder(const SupplyProblem& problem) : problem_(problem), stops_(problem.table.services.size()) {
    find_headings();
    place_vertices();
    join_vertices();
  }
  SupplyGraph graph;

 private:
  [[nodiscard]] const Drive& drive(std::size_t from, std::size_t to) const {
    return problem_.table.drives[from * stops_ + to];
  }
  [[nodiscard]] bool leads(std::size_t from, std::size_t to) const {
    return from != to && std::isfinite(drive(from, to).time_s);
  }
  [[nodiscard]] bool is_used(std::size_t stop) const {
    return stop == 0 ||
           (leads(0, stop) && (!problem_.table.services[stop].empty() ||
                               std::ranges::count(problem_.stations, stop, &TourStation::stop) > 0));
  }
  [[nodiscard]] double heading_after(std::size_t from, double heading, std::size_t to) const {
    if (from == to || drive(from, to).time_s == 0.0) return heading;
    return wrap_angle(drive(from, to).arrival_rad);
  }

  /// Adds the headings with which a stop can be reached, until there are no more.
  void find_headings() {
    headings_.resize(stops_);
    headings_[0].insert(wrap_angle(problem_.table.heading_rad));
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t from = 0; from < stops_; ++from) {
        for (std::size_t to = 0; to < stops_; ++to) {
          if (!leads(from, to) || !is_used(to)) continue;
          const std::set<double> before = headings_[from];
          for (const double h : before) grew |= headings_[to].insert(heading_after(from, h, to)).second;
        }
      }
    }
  }

  /// How often an optimal tour can come to the station with that heading.
  [[nodiscard]] std::size_t copies(std::size_t station, double heading) const {
    const std::size_t stop = problem_.stations[station].stop;
    std::size_t most = 0;
    for (std::size_t from = 0; from < stops_; ++from) {
      if (from != stop && !leads(from, stop)) continue;
      const auto fits = [&](double h) { return heading_after(from, h, stop) == heading; };
      if (std::ranges::none_of(headings_[from], fits)) continue;
      most += problem_.table.services[from].size() + (from == 0 ? 1 : 0);
      for (std::size_t other = 0; other < problem_.stations.size(); ++other) {
        if (other != station && problem_.stations[other].stop == from) most += problem_.table.goals;
      }
    }
    return most;
  }

  [[nodiscard]] double charge_of(std::size_t from, double heading, std::size_t to, double* time) const {
    *time = 0.0;
    if (from == to || drive(from, to).time_s == 0.0) return 0.0;
    const double turn = std::abs(wrap_angle(drive(from, to).departure_rad - heading));
    *time = duration(turn, problem_.table.turning) + drive(from, to).time_s;
    return problem_.charge_per_second * *time +
           problem_.charge_per_metre * problem_.lengths_m[from * stops_ + to];
  }

  [[nodiscard]] double home_from(std::size_t stop, double heading) const {
    std::optional<double> least;
    for (const TourStation& station : problem_.stations) {
      if (station.store != Store::charge || (station.stop != stop && !leads(stop, station.stop))) continue;
      double time = 0.0;
      const double charge = charge_of(stop, heading, station.stop, &time);
      least = std::min(least.value_or(charge), charge);
    }
    return least.value_or(0.0);
  }

  void place_vertices() {
    SupplyVertex start;
    start.heading = wrap_angle(problem_.table.heading_rad);
    graph.vertices.push_back(start);
    for (std::size_t stop = 0; stop < stops_; ++stop) {
      if (!is_used(stop)) continue;
      for (const double heading : headings_[stop]) {
        for (const Service& service : problem_.table.services[stop]) {
          graph.vertices.push_back({stop,
                                    heading,
                                    service.goal,
                                    {},
                                    0,
                                    service.yaw_rad - heading,
                                    service.pitch_rad,
                                    service.duration_s,
                                    home_from(stop, heading)});
        }
        for (std::size_t f = 0; f < problem_.stations.size(); ++f) {
          if (problem_.stations[f].stop != stop) continue;
          for (std::size_t copy = 0; copy < copies(f, heading); ++copy) {
            graph.vertices.push_back({stop, heading, {}, f, copy, 0.0, 0.0, 0.0, 0.0});
          }
        }
      }
    }
  }

  void join_vertices() {
    const auto& vertices = graph.vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const SupplyVertex& u = vertices[i];
      for (std::size_t j = 1; j < vertices.size(); ++j) {
        const SupplyVertex& v = vertices[j];
        if (i == j || (u.stop != v.stop && !leads(u.stop, v.stop))) continue;
        if ((u.goal && u.goal == v.goal) || (u.station && u.station == v.station)) continue;
        if (heading_after(u.stop, u.heading, v.stop) != v.heading) continue;
        double time = 0.0;
        double charge = charge_of(u.stop, u.heading, v.stop, &time);
        const double aim = std::max(std::abs(wrap_angle(v.yaw - u.yaw)) / problem_.table.yaw_rate_radps,
                                    std::abs(v.pitch - u.pitch) / problem_.table.pitch_rate_radps);
        charge += problem_.charge_per_second * (aim + v.duration) + (v.goal ? problem_.charge_per_shot : 0.0);
        if (charge <= problem_.charge) graph.arcs.push_back({i, j, time + aim + v.duration, charge});
      }
      if (u.goal) graph.arcs.push_back({i, vertices.size(), 0.0, 0.0});
    }
  }

  const SupplyProblem& problem_;
  std::size_t stops_;
  std::vector<std::set<double>> headings_;  // by stop
};

}  // namespace

SupplyGraph supply_graph(const SupplyProblem& problem) { return std::move(Builder(problem).graph); }

}  // namespace outrider::tour
