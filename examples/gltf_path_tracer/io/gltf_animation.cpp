// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/gltf_accessor.hpp"
#include "io/gltf_parts.hpp"

namespace path_tracer::gltf {
namespace {

std::vector<double> mixed(std::vector<double> const& a, std::vector<double> const& b, double t) {
  std::vector<double> result(a);
  for (std::size_t k = 0; k < a.size(); ++k) result[k] += t * (b[k] - a[k]);
  return result;
}

std::vector<double> slerped(std::vector<double> const& a, std::vector<double> const& b, double t) {
  glm::dquat const p(a[3], a[0], a[1], a[2]), q(b[3], b[0], b[1], b[2]);
  glm::dquat const r = glm::slerp(glm::normalize(p), glm::normalize(q), t);
  return {r.x, r.y, r.z, r.w};
}

}  // namespace

animations::animations(document& d) {
  for (std::size_t k = 0; k < d.model.animations.size(); ++k) {
    where_ = element(d.root, "animations", k);
    for (tinygltf::AnimationChannel const& from : d.model.animations[k].channels)
      if (from.target_node >= 0) add(d, d.model.animations[k], from);
  }
}

void animations::fail(std::string const& what) const {
  throw std::runtime_error(where_ + ": " + what);
}

void animations::add(document& d, tinygltf::Animation const& animation,
                     tinygltf::AnimationChannel const& from) {
  std::string const& path = from.target_path;
  if (path != "translation" && path != "rotation" && path != "scale")
    return d.left_out.add("animation of \"" + path + "\"", where_);
  auto const number = static_cast<std::size_t>(from.sampler);
  if (from.sampler < 0 || number >= animation.samplers.size())
    fail("a channel refers to no sampler of it");
  tinygltf::AnimationSampler const& sampler = animation.samplers[number];
  bool const cubic = sampler.interpolation == "CUBICSPLINE";
  if (!cubic && sampler.interpolation != "STEP" && sampler.interpolation != "LINEAR")
    fail("its interpolation \"" + sampler.interpolation + "\" is none of glTF's");
  if (cubic) d.left_out.add("the curve of an animation between its keys", where_);

  elements const keys = open_accessor(d, where_, sampler.input, "input");
  elements const values = open_accessor(d, where_, sampler.output, "output");
  auto const type_of = [&](int accessor) {
    return d.model.accessors[static_cast<std::size_t>(accessor)].type;
  };
  bool const rotates = path == "rotation";
  bool const is_float = values.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (keys.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT ||
      type_of(sampler.input) != TINYGLTF_TYPE_SCALAR ||
      type_of(sampler.output) != (rotates ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3) ||
      !(is_float || (rotates && values.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)))
    fail("its keys are not of the types that glTF asks for");
  std::size_t const per_key = cubic ? 3 : 1;
  if (values.count != keys.count * per_key)
    fail("it has " + std::to_string(values.count) + " values for " + std::to_string(keys.count) +
         " keys");

  channel c{
      static_cast<std::size_t>(from.target_node), path, sampler.interpolation == "STEP", {}, {}};
  for (std::size_t i = 0; i < keys.count; ++i) {
    c.times.push_back(double{keys.real_at(i, 0)});
    if (!std::isfinite(c.times[i]) || (i > 0 && !(c.times[i] > c.times[i - 1])))
      fail("the times of its keys do not increase");
    std::vector<double> value;
    for (std::size_t j = 0; j < (rotates ? 4u : 3u); ++j)
      value.push_back(double{values.real_at(i * per_key + per_key / 2, j)});
    c.values.push_back(value);
  }
  channels_.push_back(c);
}

pose animations::at(std::size_t node, double seconds) const {
  pose result;
  for (channel const& c : channels_) {
    if (c.node != node) continue;
    auto const next = std::upper_bound(c.times.begin(), c.times.end(), seconds);
    auto const k = static_cast<std::size_t>(next - c.times.begin());
    std::vector<double> value = k == 0 ? c.values.front() : c.values[k - 1];
    if (k > 0 && k < c.times.size() && !c.steps) {
      double const t = (seconds - c.times[k - 1]) / (c.times[k] - c.times[k - 1]);
      value = c.path == "rotation" ? slerped(c.values[k - 1], c.values[k], t)
                                   : mixed(c.values[k - 1], c.values[k], t);
    }
    (c.path == "translation" ? result.translation
     : c.path == "rotation"  ? result.rotation
                             : result.scale) = value;
  }
  return result;
}

}  // namespace path_tracer::gltf
