#include "outrider/io/camera/camera_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "files/yaml.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

/// Returns the value of the first key if the map has it, else that of the second.
YAML::Node either(const YAML::Node& map, const char* first, const char* second) {
  const YAML::Node node = map[first];
  return node.IsDefined() ? node : map[second];
}

/// Returns the numbers of a sequence, or of the sequence `data` in a map.
std::optional<std::vector<double>> matrix_of(const YAML::Node& node) {
  return yaml_numbers(node.IsMap() ? node["data"] : node);
}

Status read_matrix(const YAML::Node& node, const std::string& name, Camera& camera) {
  const std::string where = yaml_where(name, node);
  const auto k = matrix_of(node);
  if (!k || k->size() != 9) {
    return bad_input("the camera matrix is not valid; expected nine numbers by rows: fx 0 cx 0 fy cy 0 0 1",
                     where);
  }
  const auto& m = *k;
  const double determinant = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                             m[2] * (m[3] * m[7] - m[4] * m[6]);
  if (determinant == 0.0) {
    return bad_input(
        fmt::format("the camera matrix is singular (fx = {:g}, fy = {:g}); calibrate again", m[0], m[4]),
        where);
  }
  if (m[1] != 0.0 || m[3] != 0.0 || m[6] != 0.0 || m[7] != 0.0 || m[8] != 1.0) {
    return bad_input("the camera matrix is that of no pinhole; its rows are fx 0 cx, 0 fy cy, 0 0 1", where);
  }
  camera.fx = m[0];
  camera.cx = m[2];
  camera.fy = m[4];
  camera.cy = m[5];
  return {};
}

Status read_lens(const YAML::Node& map, const std::string& name, Camera& camera) {
  const YAML::Node model = map["distortion_model"];
  if (model.IsDefined() && yaml_text(model) != "plumb_bob") {
    return bad_input("this distortion_model is not known; expected plumb_bob", yaml_where(name, model));
  }
  const YAML::Node node = either(map, "distortion_coefficients", "D");
  if (!node.IsDefined()) return {};
  const auto lens = matrix_of(node);
  if (!lens || (!lens->empty() && lens->size() != 4 && lens->size() != 5)) {
    return bad_input("the distortion is not valid; expected four or five numbers: k1 k2 p1 p2 k3",
                     yaml_where(name, node));
  }
  std::ranges::copy(*lens, camera.distortion.begin());
  return {};
}

Status read_side(const YAML::Node& node, const std::string& name, int& side) {
  if (!node.IsDefined()) return {};
  const auto value = number<int>(yaml_text(node).value_or(""));
  if (!value || *value < 1 || *value > 100'000) {
    return bad_input("the size of the image is not valid; expected a whole number from 1 to 100000 px",
                     yaml_where(name, node));
  }
  side = *value;
  return {};
}

bool has_matrix(const YAML::Node& map) { return either(map, "camera_matrix", "K").IsDefined(); }

/// Returns the map that contains the camera matrix: the document or one of its sections.
Outcome<YAML::Node> camera_in(const YAML::Node& root, const std::string& name, const std::string& section) {
  if (section.empty() && root.IsMap() && has_matrix(root)) return root;
  std::vector<std::string> sections;
  if (root.IsMap()) {
    for (const auto& entry : root) {
      if (!entry.second.IsMap() || !has_matrix(entry.second)) continue;
      sections.push_back(excerpt(entry.first.Scalar()));
      if (entry.first.Scalar() == section) return entry.second;
    }
  }
  if (sections.empty()) {
    return bad_input("it has no camera matrix; expected the key camera_matrix with data, or K", name);
  }
  return bad_input(fmt::format("its cameras are {}; {}", fmt::join(sections, ", "),
                               section.empty() ? "name one of them"
                                               : fmt::format("'{}' is none of them", excerpt(section))),
                   name);
}

}  // namespace

Outcome<Camera> camera_from_text(std::string_view text, const std::string& name, const std::string& section) {
  auto root = yaml_map(text, name);
  if (!root) return pass_on(root);
  auto map = camera_in(*root, name, section);
  if (!map) return pass_on(map);
  Camera camera;
  camera.width_px = camera.height_px = 0;
  const YAML::Node matrix = either(*map, "camera_matrix", "K");
  Status status = read_matrix(matrix, name, camera);
  if (status) status = read_lens(*map, name, camera);
  if (status) status = read_side(either(*map, "image_width", "width"), name, camera.width_px);
  if (status) status = read_side(either(*map, "image_height", "height"), name, camera.height_px);
  if (!status) return pass_on(status);
  Camera sized = camera;
  sized.width_px = std::max(1, camera.width_px);
  sized.height_px = std::max(1, camera.height_px);
  if (auto good = check_camera(sized); !good) {
    return bad_input(good.error().sentence, yaml_where(name, matrix));
  }
  return camera;
}

Outcome<Camera> load_camera(const std::string& path, const std::string& section) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  return camera_from_text(*text, path, section);
}

}  // namespace outrider
