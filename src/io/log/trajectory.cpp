#include "outrider/io/log/trajectory.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iterator>
#include <span>

#include "log/log_lines.hpp"
#include "outrider/core/text.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

constexpr std::string_view tum_form = "'time x y z qx qy qz qw'";
constexpr std::string_view kitti_form = "12 numbers, the upper three rows of a pose matrix";
constexpr double latest_s = 2147483647.0;  // the last that ROS can stamp

using Matrix34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/// Splits a decimal number of seconds, so that its nanoseconds are exact.
Outcome<std::int64_t> time_of(std::string_view word) {
  const auto whole = number<double>(word);
  if (!whole || !(*whole >= 0.0) || *whole > latest_s) {
    return bad_input(
        fmt::format("'{}' is no time from 0 to {} s; a line is {}", excerpt(word), latest_s, tum_form));
  }
  const std::size_t point = word.find('.');
  const auto all_digits = [](std::string_view text) {
    return text.find_first_not_of("0123456789") == text.npos;
  };
  const std::string_view before = word.substr(0, point);
  std::string after(point == std::string_view::npos ? "" : word.substr(point + 1, 9));
  const auto s = number<std::uint64_t>(before);
  if (!s || !all_digits(after)) return nanoseconds(*whole);  // such as 1.5e9
  after.resize(9, '0');
  return static_cast<std::int64_t>(*s * 1'000'000'000 + number<std::uint64_t>(after).value_or(0));
}

}  // namespace

Stamped<geometry_msgs::Pose> stamped_pose(double time_s, const Pose2& pose) {
  const double whole_s = std::floor(time_s);  // apart from the rest, which then keeps all of its digits
  return {static_cast<std::int64_t>(whole_s) * 1'000'000'000 + nanoseconds(time_s - whole_s), pose_of(pose)};
}

std::string tum_text_of(std::size_t count,
                        const std::function<Stamped<geometry_msgs::Pose>(std::size_t)>& pose_at) {
  constexpr std::size_t most_line_bytes = 200;  // pages that are not written take no memory
  std::string text = "# time x y z qx qy qz qw\n";
  text.reserve(most_line_bytes * (count + 1));
  for (std::size_t i = 0; i < count; ++i) {
    const auto [time_ns, pose] = pose_at(i);
    const auto& [at, q] = pose;
    fmt::format_to(std::back_inserter(text), "{}.{:09} {} {} {} {} {} {} {}\n", time_ns / 1'000'000'000,
                   time_ns % 1'000'000'000, at.x, at.y, at.z, q.x, q.y, q.z, q.w);
  }
  return text;
}

std::string track_csv(const std::vector<Pose2>& poses) {
  std::string text = "step,x,y,heading\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", i, poses[i].position.x, poses[i].position.y,
                   poses[i].heading_rad);
  }
  return text;
}

std::string tum_text(const Trajectory& trajectory) {
  return tum_text_of(trajectory.size(), [&](std::size_t i) { return trajectory[i]; });
}

Outcome<Trajectory> trajectory_from_tum(std::string_view text, const std::string& name) {
  Trajectory trajectory;
  auto ok = for_each_line({text, name}, [&](std::span<const std::string_view> words) -> Status {
    auto time_ns = time_of(words[0]);
    if (!time_ns) return pass_on(time_ns);
    const auto v = line_numbers(words.subspan(1), 7, tum_form);
    if (!v) return bad_input(v.error().sentence);
    if (!trajectory.empty() && *time_ns < trajectory.back().time_ns) {
      return bad_input(fmt::format("the time goes back to {} s; sort the lines by time", excerpt(words[0])));
    }
    const Eigen::Quaterniond q((*v)[6], (*v)[3], (*v)[4], (*v)[5]);
    if (!(std::abs(q.norm() - 1.0) < 0.01)) {
      return bad_input(
          fmt::format("the quaternion has the length {:.3f}, and not 1; a line is {}", q.norm(), tum_form));
    }
    trajectory.push_back({*time_ns, {{(*v)[0], (*v)[1], (*v)[2]}, {(*v)[3], (*v)[4], (*v)[5], (*v)[6]}}});
    return {};
  });
  if (!ok) return pass_on(ok);
  if (trajectory.empty()) return bad_input(fmt::format("it has no pose; a line is {}", tum_form), name);
  return trajectory;
}

std::string kitti_text(const Trajectory& trajectory) {
  std::string text;
  for (const auto& [time_ns, pose] : trajectory) {
    const auto& [at, q] = pose;
    Matrix34 matrix;
    matrix << Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix(),
        Eigen::Vector3d(at.x, at.y, at.z);
    for (Eigen::Index i = 0; i < 12; ++i) {
      fmt::format_to(std::back_inserter(text), "{}{}", matrix.data()[i], i == 11 ? '\n' : ' ');
    }
  }
  return text;
}

Outcome<Trajectory> trajectory_from_kitti(std::string_view text, const std::string& name, double period_s) {
  Trajectory trajectory;
  auto ok = for_each_line({text, name}, [&](std::span<const std::string_view> words) -> Status {
    const auto v = line_numbers(words, 12, kitti_form);
    if (!v) return bad_input(v.error().sentence);
    const Matrix34 matrix = Eigen::Map<const Matrix34>(v->data());
    const Eigen::Matrix3d rotation = matrix.leftCols<3>();
    const double off = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (!(off < 0.01) || rotation.determinant() < 0.0) {
      return bad_input(fmt::format("the rotation in it is none; a line is {}", kitti_form));
    }
    const double time_s = period_s * static_cast<double>(trajectory.size());
    const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
    trajectory.push_back(
        {nanoseconds(time_s), {{matrix(0, 3), matrix(1, 3), matrix(2, 3)}, {q.x(), q.y(), q.z(), q.w()}}});
    return {};
  });
  if (!ok) return pass_on(ok);
  if (trajectory.empty()) return bad_input(fmt::format("it has no pose; a line is {}", kitti_form), name);
  return trajectory;
}

}  // namespace outrider
