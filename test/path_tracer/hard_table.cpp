// SPDX-License-Identifier: Apache-2.0
// Prints the table of docs/hard-cases.md: errors of naive formulas and of ours.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bsdf_support.hpp"
#include "hard_support.hpp"
#include "scene/lights.hpp"
#include "scene/surface.hpp"
#include "shading/stages.hpp"

using namespace path_tracer;

namespace {
double const exact_pi = std::acos(-1.0);

void row(char const* hard, char const* measure, double naive, double ours) {
  std::printf("| %s | %s | %.2g | %.2g |\n", hard, measure, naive, ours);
  INFO(hard);
  CHECK(ours < std::max(naive, 1e-6));
}

/// The larger of an error and a new one, which counts as infinite if it is not a number.
void keep_worst(double& worst, double error) {
  worst = std::max(worst, std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
}

float naive_fresnel(float c, float eta) {
  float const sin2 = std::max(1 - c * c, 0.0f) / (eta * eta);
  if (!(sin2 < 1)) return 1;
  float const t = std::sqrt(1 - sin2);
  float const s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
  return 0.5f * (s * s + p * p);
}
double exact_fresnel(long double c, long double eta) {
  long double const sin2 = (1 - c) * (1 + c) / (eta * eta);
  if (sin2 >= 1) return 1;
  long double const t = std::sqrt(1 - sin2);
  long double const s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
  return static_cast<double>((s * s + p * p) / 2);
}

void fresnel_rows(fine_numbers& n) {
  auto const compare = [&](char const* name, double low, double high, bool relative) {
    double naive = 0, ours = 0;
    for (int i = 0; i < 300000; ++i) {
      auto const eta = static_cast<float>(1 + (high > 0 ? n.over_decades(low, high) : 0));
      auto const c = static_cast<float>(n.over_decades(1e-6, 1));
      double const exact = exact_fresnel(c, eta), scale = relative ? exact : 1;
      float t;
      keep_worst(naive, std::abs(double{naive_fresnel(c, eta)} - exact) / scale);
      keep_worst(ours, std::abs(double{fresnel_dielectric(c, eta, t)} - exact) / scale);
    }
    row(name, relative ? "largest relative error" : "largest error", naive, ours);
  };
  compare("Fresnel, index 1", 0, 0, false);
  compare("Fresnel, index 1 + 1e-6 to 1 + 1e-3", 1e-6, 1e-3, true);
  compare("Fresnel, index 1.1 to 2.5", 0.1, 1.5, false);
}

void direction_rows(fine_numbers& n) {
  double naive = 0, ours = 0;
  for (int i = 0; i < 300000; ++i) {
    auto const c = static_cast<float>(1 - n.over_decades(1e-7, 1));
    double const exact = std::sqrt((1 - double{c}) * (1 + double{c}));
    if (exact == 0) continue;
    keep_worst(naive, std::abs(std::sqrt(double{1 - c * c}) / exact - 1));
    keep_worst(ours, std::abs(double{polar(c, 0).x} / exact - 1));
  }
  row("sine of a small angle from its cosine", "largest relative error", naive, ours);
  naive = ours = 0;
  for (int i = 0; i < 300000; ++i) {
    auto const g = static_cast<float>(n.over_decades(0.5, 0.99));
    auto const c = static_cast<float>(1 - n.over_decades(1e-7, 1));
    double const dg = double{g}, root2 = 1 + dg * dg - 2 * dg * double{c};
    double const exact = (1 - dg * dg) / (4 * exact_pi * root2 * std::sqrt(root2));
    float const root = std::sqrt(1 + g * g - 2 * g * c);
    keep_worst(naive, std::abs(double{(1 - g * g) / (4 * pi * root * root * root)} / exact - 1));
    keep_worst(ours, std::abs(double{phase(g, c)} / exact - 1));
  }
  row("phase function near its peak, g to 0.99", "largest relative error", naive, ours);
  naive = ours = 0;
  for (int i = 0; i < 300000; ++i) {
    double const alpha = double{min_alpha}, slope = alpha * n.over_decades(0.1, 10);
    vec3 const m(glm::normalize(glm::dvec3(slope, 0, 1)));
    double const e = double{m.x} * double{m.x} / (alpha * alpha) + double{m.z} * double{m.z};
    double const exact = 1 / (exact_pi * alpha * alpha * e * e);
    float const f = (1 - m.z * m.z) / (min_alpha * min_alpha) + m.z * m.z;
    keep_worst(naive, std::abs(double{1 / (pi * min_alpha * min_alpha * f * f)} / exact - 1));
    keep_worst(ours, std::abs(double{ggx{min_alpha}.d(m)} / exact - 1));
  }
  row("GGX of roughness 0", "largest relative error of the density", naive, ours);
}

double skew(vec3 n, vec3 t) {
  glm::dvec3 const a(n), b(t);
  return std::max(std::abs(glm::dot(a, b)), std::abs(glm::length(b) - 1));
}

void frame_rows(fine_numbers& n) {
  double naive = 0, ours = 0;
  for (int i = 0; i < 300000; ++i) {
    double const sine = n.over_decades(1e-6, 1), phi = 6.3 * n.uniform();
    vec3 const m(sine * std::cos(phi), sine * std::sin(phi), -std::sqrt((1 - sine) * (1 + sine)));
    float const a = m.z > -1 ? -1 / (1 + m.z) : -INFINITY;
    surface s;
    set_frame(s, m, vec3{0});
    keep_worst(naive, skew(m, {1 + m.x * m.x * a, m.x * m.y * a, -m.x}));
    keep_worst(ours, skew(m, s.tangent));
  }
  row("tangent of a normal near -z", "largest error of length or angle", naive, ours);
  naive = ours = 0;
  for (int i = 0; i < 300000; ++i) {
    glm::dvec3 const up = n.on_sphere();
    vec3 const m(up), hint(up + n.over_decades(1e-5, 1) * n.on_sphere());
    surface s;
    set_frame(s, m, hint);
    keep_worst(naive, skew(m, glm::normalize(hint - m * glm::dot(m, hint))));
    keep_worst(ours, skew(m, s.tangent));
  }
  row("tangent along a direction next to the normal", "largest error of length or angle", naive,
      ours);
}

bool moeller_trumbore(triangle const& t, ray const& r) {
  vec3 const e1 = t.position[1] - t.position[0], e2 = t.position[2] - t.position[0];
  vec3 const p = glm::cross(r.direction, e2), s = r.origin - t.position[0];
  float const det = glm::dot(e1, p), u = det != 0 ? glm::dot(s, p) / det : -1.0f;
  vec3 const q = glm::cross(s, e1);
  float const v = det != 0 ? glm::dot(r.direction, q) / det : -1.0f;
  return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(e2, q) / det > 0;
}

void ray_rows(fine_numbers& n) {
  int const rays = 1000000;
  auto const mesh = ball({1000, -500, 250}, 1, 1);
  double naive = 0, ours = 0;
  for (int i = 0; i < rays; ++i) {
    triangle const& t = mesh[n.below(mesh.size())];
    vec3 const at = glm::mix(t.position[0], t.position[1], static_cast<float>(n.uniform()));
    ray const r{{1000, -500, 250}, at - vec3{1000, -500, 250}, INFINITY};
    bool by_naive = false, by_ours = false;
    sheared_ray const sheared(r);
    for (triangle const& other : mesh) {
      hit h;
      h.t = INFINITY;
      by_naive = by_naive || moeller_trumbore(other, r);
      by_ours = by_ours || sheared.intersect(stored(other), h);
    }
    naive += by_naive ? 0 : 1;
    ours += by_ours ? 0 : 1;
  }
  row("rays at the edges of a closed mesh", "leaks of 10^6 (Moeller-Trumbore, float)", naive, ours);

  double from_surface = 0, from_ulps = 0, from_ours = 0;
  for (int i = 0; i < rays; ++i) {
    glm::dvec3 const u = n.on_sphere(), v = glm::normalize(glm::cross(u, n.on_sphere())),
                     normal = glm::cross(u, v);
    double const size = n.over_decades(1e2, 1e6), c = n.over_decades(1e-6, 1);
    triangle const t =
        make_triangle(vec3(-size * u - size * v), vec3(size * u - size * v), vec3(size * v));
    material const plain;
    scene_view view{};
    view.materials = &plain;
    surface const s = load_surface<every_effect>(view, t, {0.25f, 0.5f}, vec3(-normal));
    vec3 const d(c * normal + std::sqrt((1 - c) * (1 + c)) * u);
    if (glm::dot(d, s.geometric) <= 0) continue;
    vec3 by_ulps;  // 256 units in the last place, or 2^-16 near 0
    for (int k = 0; k < 3; ++k) {
      float const ulp = std::nextafter(std::abs(s.position[k]), INFINITY) - std::abs(s.position[k]);
      float const step = std::abs(s.position[k]) < 1.0f / 32 ? 0x1p-16f : 256 * ulp;
      by_ulps[k] = s.position[k] + s.geometric[k] * step;
    }
    auto const meets = [&](vec3 origin) {
      hit h;
      h.t = INFINITY;
      return sheared_ray({origin, d, INFINITY}).intersect(stored(t), h) ? 1.0 : 0.0;
    };
    from_surface += meets(s.position);
    from_ulps += meets(by_ulps);
    from_ours += meets(s.start_towards(d));
  }
  row("rays that start on a triangle of 10^2 to 10^6", "meet it, of 10^6 (no offset)", from_surface,
      from_ours);
  row("the same", "meet it, of 10^6 (256 units in the last place)", from_ulps, from_ours);
  triangle const far = ball({1e5, -1e5, 1e5}, 1, 1)[0];
  row("start of a ray on a ball of radius 1, 10^5 away", "distance off it (256 units)",
      256 * 0x1p-7, double{clearance_of(far)});
}

void sum_rows(fine_numbers& n) {
  std::uint32_t const paths = 100000;
  std::vector<vec3> radiance(paths);
  long double exact = 0;
  for (vec3& r : radiance) {
    r = vec3{static_cast<float>(2 * n.uniform())};
    exact += r.x;
  }
  basic_batch batch{};
  batch.radiance = radiance.data();
  batch.pixels = 1;
  pixel_sum<summation::in_double> sum;
  float naive = 0;
  for (int k = 0; k < 100; ++k) {
    accumulate_samples<decltype(sum)>{batch, paths, &sum}(0);
    for (vec3 const& r : radiance) naive += r.x;
  }
  auto const total = static_cast<double>(100 * exact);
  row("mean of 10^7 samples", "relative error", std::abs(double{naive} / total - 1),
      std::abs(sum.total.x / total - 1));
}

void light_rows() {
  // By the share of random numbers that pick the dimmer of two lamps.
  scene s;
  s.materials.resize(2);
  for (std::uint32_t k = 0; k < 2; ++k) {
    s.materials[k].kind = shader_of<effects::emitters>;
    s.materials[k].emission = vec3{k == 0 ? 1 : 1e6f};
    s.triangles.push_back(make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    s.triangles.back().material = k;
  }
  light_list const list(s);
  light_view const lights = list.view(s);
  double naive = 0, ours = 0;
  for (int x = 0; x < 8192; ++x)
    for (int y = 0; y < 100; ++y) {  // beyond, the bright one
      vec2 const u{(static_cast<float>(x) + 0.5f) / 8192, static_cast<float>(y) * 0x1p-24f};
      std::uint32_t const column = x < 4096 ? 0 : 1;
      naive += column == 0 && u.y < lights.entries[0].keep ? 0x1p-37 : 0;
      ours += pick_entry(lights.entries, 2, u) == 0 ? 0x1p-37 : 0;
    }
  row("picking a lamp a million times dimmer", "relative error of its probability",
      std::abs(naive * 1000001 - 1), std::abs(ours * 1000001 - 1));
}

}  // namespace

TEST_CASE("ours is less off than the naive formula, or by next to nothing", "[hard][hard-table]") {
  fine_numbers n(661);
  std::printf("| hard case | measure | naive | ours |\n|---|---|---|---|\n");
  fresnel_rows(n);
  direction_rows(n);
  frame_rows(n);
  ray_rows(n);
  light_rows();
  sum_rows(n);
}
