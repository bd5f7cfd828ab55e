// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "io/gltf.hpp"
#include "io/gltf_parts.hpp"
#include "io/gltf_properties.hpp"

namespace path_tracer {
namespace {

using namespace gltf;

/// Walks the nodes of one scene in depth-first order and expands them.
class traversal {
 public:
  traversal(document& d, scene& out) : document_(d), scene_(out), seen_(d.model.nodes.size()) {}

  void run(std::vector<int> const& roots) {
    find_shutter(first_camera(roots));
    centre_ = centre_far_away(document_, roots);
    scene_.origin = vec3(centre_);
    glm::dmat4 const to_centre = glm::translate(glm::dmat4(1), -centre_);
    push(roots, {to_centre, to_centre});
    while (!stack_.empty()) {
      auto const [node, to_parent] = stack_.back();
      stack_.pop_back();
      visit(node, to_parent);
    }
    if (!has_camera_) throw std::runtime_error("has no camera in its default scene");
    if (scene_.triangles.empty()) throw std::runtime_error("has no triangles in its default scene");
    if (!moves_) std::vector<triangle_motion>().swap(scene_.motion);
  }

 private:
  struct placed {
    std::size_t node;
    placement to_parent;
  };

  /// The first camera in depth-first order; -1 where there is none. Its shutter comes before the
  /// nodes that are seen through it.
  int first_camera(std::vector<int> const& roots) const {
    std::vector<bool> seen(document_.model.nodes.size());
    std::vector<int> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
      auto const index = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      if (seen[index]) continue;
      seen[index] = true;
      tinygltf::Node const& node = document_.model.nodes[index];
      if (node.camera >= 0) return node.camera;
      stack.insert(stack.end(), node.children.rbegin(), node.children.rend());
    }
    return -1;
  }

  void find_shutter(int index) {
    if (index < 0) return;
    auto const number = static_cast<std::size_t>(index);
    camera c;
    read_properties(document_.root["cameras"][number], c);
    if (c.shutter_close < c.shutter_open)
      throw std::runtime_error(element(document_.root, "cameras", number) +
                               ": its shutter closes before it opens");
    open_ = double{c.shutter_open};
    close_ = double{c.shutter_close};
    if (close_ > open_)
      animations_ = animations(document_);
    else if (!document_.model.animations.empty())
      document_.left_out.add("animation without a shutter", "");
  }

  void push(std::vector<int> const& nodes, placement const& to_parent) {
    for (auto n = nodes.rbegin(); n != nodes.rend(); ++n)
      stack_.push_back({static_cast<std::size_t>(*n), to_parent});
  }

  void visit(std::size_t index, placement const& to_parent) {
    std::string const where = element(document_.root, "nodes", index);
    if (seen_[index])
      throw std::runtime_error(where + ": is reached twice, through a cycle or from two parents");
    seen_[index] = true;
    tinygltf::Node const& node = document_.model.nodes[index];
    auto const to_world_at = [&](double seconds, glm::dmat4 const& parent) {
      return parent * local_transform(document_, index, animations_.at(index, seconds));
    };
    placement const place{to_world_at(open_, to_parent.open), to_world_at(close_, to_parent.close)};
    for (glm::dmat4 const& m : {place.open, place.close}) {
      double const determinant = glm::determinant(m);
      if (!std::isfinite(determinant) || determinant == 0)
        throw std::runtime_error(where + ": its transform to world space has the determinant " +
                                 std::to_string(determinant));
      if (!(glm::length(glm::dvec3(m[3]) + centre_) <= farthest))
        throw std::runtime_error(where + ": lies more than 1e9 units from the origin");
    }
    glm::dmat4 const& to_world = place.open;
    if (node.mesh >= 0) {
      append_mesh(document_, static_cast<std::size_t>(node.mesh), place, scene_);
      moves_ = moves_ || place.open != place.close;
    }
    if (node.camera >= 0 && has_camera_) document_.left_out.add("further camera", where);
    if (node.camera >= 0 && !has_camera_) {
      scene_.view = make_camera(document_, static_cast<std::size_t>(node.camera), to_world);
      has_camera_ = true;
    }
    int const light =
        value_at(document_.root["nodes"][index], "/extensions/KHR_lights_punctual/light", -1);
    if (light >= 0) {
      auto const number = static_cast<std::size_t>(light);
      scene_.lights.push_back(make_light(document_, number, to_world));
      scene_.light_names.push_back(document_.model.lights[number].name);
    }
    if ((node.camera >= 0 || light >= 0) && place.open != place.close)
      document_.left_out.add("motion of a camera or light", where);
    push(node.children, place);
  }

  document& document_;
  scene& scene_;
  animations animations_;
  double open_ = 0, close_ = 0;  // seconds
  bool moves_ = false;
  std::vector<bool> seen_;
  std::vector<placed> stack_;
  bool has_camera_ = false;
  glm::dvec3 centre_{0};  // of a scene far away: it is moved to the origin
};

scene make_scene(document& d) {
  if (d.model.scenes.empty()) throw std::runtime_error("has no scene");
  scene result;
  append_materials(d, result);
  std::size_t const index =
      d.model.defaultScene < 0 ? 0 : static_cast<std::size_t>(d.model.defaultScene);
  for (std::size_t i = 0; i < d.model.scenes.size(); ++i)
    if (i != index)
      d.left_out.add("scene that is not the default one", element(d.root, "scenes", i));
  traversal(d, result).run(d.model.scenes[index].nodes);
  auto const background =
      value_at(d.root["scenes"][index], "/extras/background", std::vector<double>{0, 0, 0});
  result.background = vec3(glm::dvec3(background[0], background[1], background[2]));
  read_properties(d.root["scenes"][index], result);
  result.warnings = d.left_out.lines();
  return result;
}

template <class Effect, class = void>
constexpr bool has_load = false;
template <class Effect>
constexpr bool has_load<Effect, std::void_t<decltype(&Effect::template load<scene>)>> = true;

/// Loads the files beside the scene's that effects need.
void load_files(std::string const& path, scene& s) {
  auto const slash = path.rfind('/');
  std::string const folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  for_each_effect(all_effects{}, [&](auto effect) {
    if constexpr (has_load<decltype(effect)>) decltype(effect)::load(s, folder);
  });
}

/// Names come from the file, and messages of tinygltf may hold all of it.
std::string one_line(std::string text) {
  constexpr std::size_t longest = 240;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

scene load_gltf(std::string const& path, effect_bits allowed) {
  try {
    document d = read_document(path);
    scene result = make_scene(d);
    if (!allowed.all()) leave_out_others(result, allowed);
    load_files(path, result);
    for (std::string& warning : result.warnings) warning = one_line(path + ": " + warning);
    return result;
  } catch (std::runtime_error const& e) {
    throw std::runtime_error(path + ": " + one_line(e.what()));
  }
}

}  // namespace path_tracer
