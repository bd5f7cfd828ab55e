// SPDX-License-Identifier: Apache-2.0
// The rays of hard_geometry.cpp and hard_origins.cpp on the device: closed meshes that none leaks
// through, and triangles that none meets again; 10^7 rays each.
#include "../../catch.hpp"
#include "../hard_support.hpp"
#include "device_support.hpp"
#include "scene/bvh_builder.hpp"
#include "scene/surface.hpp"

using namespace path_tracer;

namespace {

/// A mesh and its hierarchy, built on the host, in the memory of the device.
class device_mesh {
 public:
  explicit device_mesh(std::vector<triangle> const& mesh)
      : triangles_(mesh.begin(), mesh.end()), materials_(1, material{}) {
    bvh const tree = build_bvh(mesh);
    nodes_ = tree.nodes;
    leaves_ = tree.triangles;
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }
  scene_view view() const {
    scene_view view{};
    view.bvh = {thrust::raw_pointer_cast(nodes_.data()), thrust::raw_pointer_cast(leaves_.data())};
    view.triangles = thrust::raw_pointer_cast(triangles_.data());
    view.materials = thrust::raw_pointer_cast(materials_.data());
    return view;
  }

 private:
  thrust::device_vector<triangle> triangles_;
  thrust::device_vector<material> materials_;
  thrust::device_vector<bvh_node> nodes_;
  thrust::device_vector<bvh_triangle> leaves_;
};

/// Ray i from about the middle of a closed mesh at a corner, an edge or a triangle: 1 if it meets
/// nothing.
struct leak {
  scene_view mesh;
  std::uint32_t count;
  glm::dvec3 centre;
  double radius;
  std::uint64_t seed;
  PT_HD std::uint64_t operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    triangle const& t = mesh.triangles[n.below(count)];
    auto const k = static_cast<int>(i % 3);
    float const along = i % 4 == 0 ? 0.0f : static_cast<float>(n.uniform());
    vec3 target = glm::mix(t.position[k], t.position[(k + 1) % 3], along);
    if (i % 4 == 3)
      target = glm::mix(target, t.position[(k + 2) % 3], static_cast<float>(n.uniform()));
    double const off = i % 8 < 4 ? 0.0 : 0.3 * n.uniform() * radius;
    vec3 const origin(centre + off * n.on_sphere());
    return any_hit(mesh.bvh, {origin, target - origin, INFINITY}) ? 0 : 1;
  }
};

std::uint64_t count_leaks(std::vector<triangle> const& triangles, glm::dvec3 centre, double radius,
                          std::uint64_t seed, std::uint64_t rays) {
  device_mesh const mesh(triangles);
  return sum_on_device(leak{mesh.view(), mesh.size(), centre, radius, seed}, rays);
}

/// Rays that started, and rays that met a triangle, in one number.
PT_HD std::uint64_t counted(bool met) { return (std::uint64_t{1} << 32) + (met ? 1 : 0); }

/// A direction at a grazing angle over a plane, the cosine from 1e-6 to 1 uniform in its logarithm.
PT_HD vec3 grazing(glm::dvec3 normal, device_numbers& n) {
  double const c = n.over_decades(1e-6, 1);
  glm::dvec3 aside = n.on_sphere();
  aside = glm::normalize(aside - glm::dot(aside, normal) * normal);
  return vec3(glm::normalize(c * normal + std::sqrt((1 - c) * (1 + c)) * aside));
}

PT_HD vec2 place(device_numbers& n) {
  double const root = std::sqrt(n.uniform()), u = n.uniform();
  return {static_cast<float>(root * (1 - u)), static_cast<float>(root * u)};
}

PT_HD glm::dvec3 crossed(triangle const& t) {
  glm::dvec3 const a(t.position[0]);
  return glm::cross(glm::dvec3(t.position[1]) - a, glm::dvec3(t.position[2]) - a);
}

/// Whether a ray from a surface on `t` meets `t`.
PT_HD bool meets(triangle const& t, vec3 origin, vec3 direction) {
  bvh_triangle same{};
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis) same.corner[k][axis] = t.position[k][axis];
  hit h;
  h.t = INFINITY;
  return sheared_ray({origin, direction, INFINITY}).intersect(same, h);
}

/// A triangle of size 1e-4 to 1e6, up to 1e6 away; not one that float does not have, and no sliver.
PT_HD triangle any_triangle(device_numbers& n) {
  for (;;) {
    double const size = n.over_decades(1e-4, 1e6);
    glm::dvec3 const centre = n.over_decades(1e-3, 1e6) * n.on_sphere();
    if (glm::length(centre) > 1e5 * size) continue;
    triangle t{};
    for (vec3& p : t.position) p = vec3(centre + size * n.on_sphere());
    if (glm::length(crossed(t)) >= 0.01 * size * size) return t;
  }
}

/// Ray i from a triangle of its own, on either side; `naive`: from the surface itself. None starts
/// that is on the other side in float.
struct return_to_triangle {
  scene_view view;
  std::uint64_t seed;
  bool naive;
  PT_HD std::uint64_t operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    triangle const t = any_triangle(n);
    vec2 const at = place(n);
    surface const s = load_surface<every_effect>(view, t, at, vec3(n.on_sphere()));
    glm::dvec3 const normal = glm::normalize(crossed(t));
    double const outside = glm::dot(normal, glm::dvec3(s.geometric)) > 0 ? 1 : -1;
    double const side = i % 2 == 0 ? 1 : -1;
    vec3 const direction = grazing(side * outside * normal, n);
    if (double{glm::dot(direction, s.geometric)} * side <= 0) return 0;
    return counted(meets(t, naive ? s.position : s.start_towards(direction), direction));
  }
};

/// Ray i from the outside of a convex mesh.
struct return_to_mesh {
  scene_view mesh;
  std::uint32_t count;
  std::uint64_t seed;
  PT_HD std::uint64_t operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    triangle const& t = mesh.triangles[n.below(count)];
    vec3 const outside = geometric_normal(t);
    surface const s = load_surface<every_effect>(mesh, t, place(n), -outside);
    vec3 const direction = grazing(glm::normalize(glm::dvec3(outside)), n);
    return counted(any_hit(mesh.bvh, {s.start_towards(direction), direction, INFINITY}));
  }
};

std::uint64_t met(std::uint64_t counts) { return counts & 0xffffffffu; }

}  // namespace

TEST_CASE("no ray leaks through a closed mesh on the device", "[hard]") {
  std::uint64_t seed = 681, rays = 0;
  for (double const radius : {1e-4, 1.0, 1e3, 1e6})
    for (double const away : {0.0, 1.0, 1e3, 1e6}) {
      if (away > radius * 2e6) continue;  // nothing is left of the ball in float
      glm::dvec3 const centre = away * glm::dvec3(1, -0.5, 0.25);
      CAPTURE(seed, radius, away);
      std::uint64_t const count = 750000;
      CHECK(count_leaks(ball(centre, radius, 1), centre, radius, seed, count) == 0);
      rays += count;
      ++seed;
    }
  CHECK(rays >= many);
}

TEST_CASE("no ray leaks through slivers on the device", "[hard]") {
  std::uint64_t seed = 701;
  for (double const half : {1e-4, 1.0, 1e6})
    for (double const away : {0.0, 1.0}) {
      glm::dvec3 const centre = away * half * glm::dvec3(30, -17, 5);
      CAPTURE(seed, half, away);
      CHECK(count_leaks(sliver_cube(centre, half), centre, half, seed, many / 5) == 0);
      ++seed;
    }
}

TEST_CASE("a mesh with a hole leaks on the device", "[hard]") {
  // What the two tests above would find.
  std::vector<triangle> open = ball({3, -2, 1}, 1, 1);
  open.pop_back();
  CHECK(count_leaks(open, {3, -2, 1}, 1, 711, many / 10) > 1000);
}

TEST_CASE("no secondary ray meets the triangle that it starts on on the device", "[hard]") {
  std::uint64_t const seed = 712;
  CAPTURE(seed);
  thrust::device_vector<material> const plain(1, material{});
  scene_view view{};
  view.materials = thrust::raw_pointer_cast(plain.data());
  std::uint64_t const ours = sum_on_device(return_to_triangle{view, seed, false});
  CHECK(met(ours) == 0);
  CHECK(ours >> 32 > many * 9 / 10);
  // From the surface itself, many do.
  CHECK(met(sum_on_device(return_to_triangle{view, seed, true})) > many / 100);
}

TEST_CASE("rays that leave a convex mesh meet nothing on the device", "[hard]") {
  std::uint64_t seed = 721;
  for (double const radius : {1e-4, 1.0, 1e6})
    for (double const away : {0.0, 1.0, 1e3}) {
      device_mesh const mesh(ball(away * radius * glm::dvec3(1, -0.5, 0.25), radius, 1));
      CAPTURE(seed, radius, away);
      CHECK(met(sum_on_device(return_to_mesh{mesh.view(), mesh.size(), seed}, many / 9)) == 0);
      ++seed;
    }
}
