// Serialisation of state as text. The member template exchange(archive) of a struct both writes and reads it.
//
// Numbers are written in the shortest form that reads back the same; a list begins with its length.
#pragma once

#include <Eigen/Core>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "outrider/slam/landmark/landmark_log.hpp"

namespace outrider {

class StateWriter {
 public:
  static constexpr bool reading = false;
  std::string text;

  template <class... Parts>
  void operator()(Parts&... parts) {
    (write(parts), ...);
  }

 private:
  template <class Number>
    requires std::is_arithmetic_v<Number>
  void write(const Number& number) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
    text.append(buffer, end);
    text += ' ';
  }
  void write(const std::string& word) { text += word + ' '; }
  template <class Part>
  void write(std::vector<Part>& list) {
    write(list.size());
    for (Part& part : list) write(part);
    text += '\n';
  }
  template <int Rows, int Columns>
  void write(Eigen::Matrix<double, Rows, Columns>& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) write(matrix(i / Columns, i % Columns));
  }
  void write(Pose2& pose) { (*this)(pose.position.x, pose.position.y, pose.heading_rad); }
  void write(LandmarkSighting& s) {
    std::int64_t id = s.id.value_or(-1);
    (*this)(id, s.position.x, s.position.y, s.covariance);
  }
  template <class Part>
    requires requires(Part part, StateWriter& archive) { part.exchange(archive); }
  void write(Part& part) {
    part.exchange(*this);
  }
};

/// Reads up to the first error; `ok` is then false and the remaining values stay unchanged.
class StateReader {
 public:
  static constexpr bool reading = true;
  std::string_view rest;
  bool ok = true;

  template <class... Parts>
  void operator()(Parts&... parts) {
    (read(parts), ...);
  }
  [[nodiscard]] std::string_view word() {
    const std::size_t begin = std::min(rest.find_first_not_of(" \n"), rest.size());
    rest.remove_prefix(begin);
    const std::string_view found = rest.substr(0, rest.find_first_of(" \n"));
    rest.remove_prefix(found.size());
    if (found.empty()) ok = false;
    return found;
  }

 private:
  template <class Number>
    requires std::is_arithmetic_v<Number>
  void read(Number& number) {
    const std::string_view found = word();
    const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), number);
    if (error != std::errc{} || end != found.data() + found.size()) ok = false;
    if constexpr (std::floating_point<Number>) ok = ok && std::isfinite(number);
  }
  void read(std::string& text) { text = word(); }
  template <class Part>
  void read(std::vector<Part>& list) {
    std::size_t size = 0;
    read(size);
    list.clear();
    for (std::size_t i = 0; ok && i < size; ++i) read(list.emplace_back());
  }
  template <int Rows, int Columns>
  void read(Eigen::Matrix<double, Rows, Columns>& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) read(matrix(i / Columns, i % Columns));
  }
  void read(Pose2& pose) { (*this)(pose.position.x, pose.position.y, pose.heading_rad); }
  void read(LandmarkSighting& s) {
    std::int64_t id = -1;
    (*this)(id, s.position.x, s.position.y, s.covariance);
    s.id = id >= 0 ? std::optional(id) : std::nullopt;
  }
  template <class Part>
    requires requires(Part part, StateReader& archive) { part.exchange(archive); }
  void read(Part& part) {
    part.exchange(*this);
  }
};

}  // namespace outrider
