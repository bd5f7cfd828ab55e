// SPDX-License-Identifier: Apache-2.0
// The formulas of hard_optics.cpp, hard_sampling.cpp and hard_geometry.cpp on the device, within
// the same bounds, over 10^7 inputs each: in float, against the exact value in double.
#include "../../catch.hpp"
#include "../hard_support.hpp"
#include "device_support.hpp"
#include "scene/lights.hpp"
#include "scene/surface.hpp"
#include "shading/bsdf_glass.hpp"

using namespace path_tracer;

namespace {

constexpr double exact_pi = 3.14159265358979323846;

/// Fresnel's reflectance. In double, the cosine on the far side needs the index's distance from 1
/// multiplied out; the rest is the textbook's.
PT_HD double exact_fresnel(double c, double eta) {
  double const bent2 = (eta - 1) * (eta + 1) + c * c;
  if (!(bent2 > 0)) return 1;
  double const bent = std::sqrt(bent2);
  double const s = (c - bent) / (c + bent);
  double const p = (eta * eta * c - bent) / (eta * eta * c + bent);
  return (s * s + p * p) / 2;
}

/// By how much a reflectance leaves what angles and indices within two units in the last place of
/// those given have: 0 if it is as right as its input.
struct fresnel_error {
  std::uint64_t seed;
  double nearest, farthest;  ///< of the index from 1
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    double const off = n.over_decades(nearest, farthest);
    auto const eta = static_cast<float>(i % 2 == 0 ? 1 + off : 1 / (1 + off));
    auto const cos_i = static_cast<float>(i % 3 == 0 ? n.over_decades(1e-6, 1) : n.uniform());
    float cos_t = 0;
    double const found = double{fresnel_dielectric(cos_i, eta, cos_t)};
    double low = 2, high = -1;
    for (int a = -2; a <= 2; ++a)
      for (int b = -2; b <= 2; ++b) {
        double const e = 1 + (double{eta} - 1) * (1 + b * 0x1p-23);
        double const c = double{cos_i} * (1 + a * 0x1p-23), r = exact_fresnel(c < 1 ? c : 1, e);
        low = r < low ? r : low;
        high = r > high ? r : high;
      }
    if (found < low) return relative_error(found, low, 1e-14);
    return found > high ? relative_error(found, high, 1e-14) : (found == found ? 0 : wrong);
  }
};

struct fresnel_distance {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    auto const eta = static_cast<float>(1.1 + 1.4 * n.uniform());
    auto const cos_i = static_cast<float>(n.over_decades(1e-6, 1));
    float cos_t = 0;
    return std::abs(double{fresnel_dielectric(cos_i, eta, cos_t)} -
                    exact_fresnel(double{cos_i}, double{eta}));
  }
};

/// Of an interface that is none: the error of the angle, and no reflection at all.
struct error_at_index_one {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    auto const cos_i = static_cast<float>(device_numbers(seed, i).over_decades(1e-6, 1));
    float cos_t = 0;
    if (fresnel_dielectric(cos_i, 1, cos_t) != 0) return wrong;
    return relative_error(double{cos_t}, double{cos_i});
  }
};

struct total_reflection {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    auto const eta = static_cast<float>(1 / (1 + n.over_decades(1e-6, 1.5)));
    double const critical = std::sqrt((1 - double{eta}) * (1 + double{eta}));
    double const off = n.over_decades(1e-6, 0.05);
    float beyond = 0, before = 0;
    float const all = fresnel_dielectric(static_cast<float>(critical * (1 - off)), eta, beyond);
    float const some = fresnel_dielectric(static_cast<float>(critical * (1 + off)), eta, before);
    return all == 1 && beyond == 0 && some < 1 && some >= 0 && before > 0 ? 0 : wrong;
  }
};

struct sine_error {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    auto const c = static_cast<float>(1 - n.over_decades(1e-7, 1));
    vec3 const w = polar(c, static_cast<float>(n.angle()));
    double const found = std::sqrt(double{w.x} * double{w.x} + double{w.y} * double{w.y});
    double const exact = std::sqrt((1 - double{c}) * (1 + double{c}));
    return exact > 0 ? relative_error(found, exact) : found;
  }
};

struct phase_error {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    auto const g = static_cast<float>((i % 2 == 0 ? 1 : -1) * n.over_decades(0.1, 0.99));
    auto const c = static_cast<float>((g > 0 ? 1 : -1) * (1 - n.over_decades(1e-7, 2)));
    double const dg = double{g}, root2 = 1 + dg * dg - 2 * dg * double{c};
    double const exact = (1 - dg * dg) / (4 * exact_pi * root2 * std::sqrt(root2));
    return relative_error(double{phase(g, c)}, exact);
  }
};

struct ggx_error {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    double const alpha = double{min_alpha}, slope = alpha * n.over_decades(0.1, 10);
    double const phi = n.angle();
    vec3 const m(glm::normalize(glm::dvec3(slope * std::cos(phi), slope * std::sin(phi), 1)));
    glm::dvec3 const d(m);
    double const e = (d.x * d.x + d.y * d.y) / (alpha * alpha) + d.z * d.z;
    return relative_error(double{ggx{min_alpha}.d(m)}, 1 / (exact_pi * alpha * alpha * e * e));
  }
};

PT_HD double larger(double a, double b) { return a < b || b != b ? b : a; }

PT_HD double frame_error(vec3 normal, vec3 hint) {
  surface s{};
  set_frame(s, normal, hint);
  glm::dvec3 const t(s.tangent), u(s.up), n(s.normal);
  double worst = std::abs(glm::dot(glm::cross(t, u), n) - 1);
  worst = larger(worst, std::abs(glm::dot(t, t) - 1));
  worst = larger(worst, std::abs(glm::dot(u, u) - 1));
  worst = larger(worst, std::abs(glm::dot(t, u)));
  worst = larger(worst, std::abs(glm::dot(t, n)));
  return larger(worst, std::abs(glm::dot(u, n)));
}

/// Of any normal, half of them next to z or -z.
struct error_without_hint {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    if (i % 2 == 0) return frame_error(vec3(n.on_sphere()), vec3{0});
    double const sine = n.over_decades(1e-30, 1), phi = n.angle();
    double const z = (i % 4 == 1 ? -1 : 1) * std::sqrt(1 - sine * sine);
    return frame_error(vec3(sine * std::cos(phi), sine * std::sin(phi), z), vec3{0});
  }
};

struct error_with_hint {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    vec3 const normal(n.on_sphere());
    glm::dvec3 const off = n.over_decades(1e-9, 1) * n.on_sphere();
    return frame_error(normal, vec3(n.over_decades(1e-12, 1e12) * (glm::dvec3(normal) + off)));
  }
};

struct heuristic_error {
  std::uint64_t seed;
  PT_HD double operator()(std::uint64_t i) const {
    device_numbers n(seed, i);
    auto const a = static_cast<float>(n.over_decades(1e-30, 1e30));
    auto const b = static_cast<float>(n.over_decades(1e-30, 1e30));
    double const ratio = double{b} / double{a};
    return relative_error(double{power_heuristic(a, b)}, 1 / (1 + ratio * ratio), 1e-37);
  }
};

/// How many of the 2^24 second numbers pick light `wanted`, of those that come before the bright
/// light 1, for the first number i / 2^24.
struct picks {
  light_entry const* entries;
  std::uint32_t wanted;
  PT_HD std::uint64_t operator()(std::uint64_t i) const {
    std::uint64_t found = 0;
    for (std::uint32_t y = 0; y < 0x1000000; ++y) {
      vec2 const u{static_cast<float>(i) * 0x1p-24f, static_cast<float>(y) * 0x1p-24f};
      std::uint32_t const light = entries[pick_entry(entries, 3, u)].index;
      if (light == 1) break;
      found += light == wanted ? 1 : 0;
    }
    return found;
  }
};

}  // namespace

TEST_CASE("Fresnel's equations hold on the device", "[hard]") {
  std::uint64_t const seed = 671;
  CAPTURE(seed);
  CHECK(worst_on_device(fresnel_error{seed, 1e-7, 1e-3}) < 4e-6);
  CHECK(worst_on_device(fresnel_error{seed, 1e-3, 1.5}) < 4e-6);
  CHECK(worst_on_device(fresnel_distance{seed}) < 1e-6);
  CHECK(worst_on_device(error_at_index_one{seed}) < 1e-6);
  CHECK(worst_on_device(total_reflection{seed}) == 0);
}

TEST_CASE("directions next to the pole and peaks of densities are exact on the device", "[hard]") {
  std::uint64_t const seed = 672;
  CAPTURE(seed);
  CHECK(worst_on_device(sine_error{seed}) < 1e-6);
  CHECK(worst_on_device(phase_error{seed}) < 2e-5);
  CHECK(worst_on_device(ggx_error{seed}) < 1e-6);
}

TEST_CASE("a frame about any normal is orthonormal on the device", "[hard]") {
  std::uint64_t const seed = 673;
  CAPTURE(seed);
  CHECK(worst_on_device(error_without_hint{seed}) < 1e-6);
  CHECK(worst_on_device(error_with_hint{seed}) < 1e-6);
}

TEST_CASE("the power heuristic holds on the device for huge and tiny densities", "[hard]") {
  std::uint64_t const seed = 674;
  CAPTURE(seed);
  CHECK(worst_on_device(heuristic_error{seed}) < 1e-5);
}

TEST_CASE("the device picks a dim light as often as its density says", "[hard]") {
  // All pairs of numbers that a random_stream draws.
  for (float const bright : {1e5f, 1e6f, 3e7f}) {
    scene s;
    for (std::uint32_t k = 0; k < 3; ++k) {
      s.materials.emplace_back();
      s.materials.back().kind = shader_of<effects::emitters>;
      s.materials.back().emission = vec3{k == 1 ? bright : 1};
      s.triangles.push_back(make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
      s.triangles.back().material = k;
    }
    light_list const list(s);
    light_view const lights = list.view(s);
    REQUIRE(lights.count == 3);
    thrust::device_vector<light_entry> const entries(lights.entries, lights.entries + 3);
    light_entry const* const where = thrust::raw_pointer_cast(entries.data());
    double const dim = 1 / (2.0 + double{bright});
    double found[3] = {};
    for (std::uint32_t k : {0u, 2u})
      found[k] = static_cast<double>(sum_on_device(picks{where, k}, 0x1000000)) * 0x1p-48;
    CAPTURE(bright);
    CHECK_THAT(found[0], WithinRel(dim, 5e-3));
    CHECK_THAT(found[2], WithinRel(dim, 5e-3));
  }
}
