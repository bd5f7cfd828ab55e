// SPDX-License-Identifier: Apache-2.0
#pragma once

// Quadrature over directions that is dense where a microfacet lobe is, however narrow, and GGX in
// double precision, for the tests of BSDFs at the ends of their range.

#include <cmath>

#include "bsdf_support.hpp"

namespace path_tracer {

inline double const exact_pi = std::acos(-1.0);

/// GGX of two roughnesses along turned axes, in double.
struct exact_ggx {
  double x, y;  ///< alpha along the axes
  double cosine = 1, sine = 0;

  glm::dvec3 turned(glm::dvec3 v) const {
    return {cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
  }
  glm::dvec3 turned_back(glm::dvec3 v) const {
    return {cosine * v.x - sine * v.y, cosine * v.y + sine * v.x, v.z};
  }
  double lambda(glm::dvec3 w) const {
    glm::dvec3 const t = turned(w);
    return (std::hypot(1, std::hypot(t.x * x, t.y * y) / t.z) - 1) / 2;
  }
  double g1(glm::dvec3 w) const { return 1 / (1 + lambda(w)); }
  double g2(glm::dvec3 a, glm::dvec3 b) const { return 1 / (1 + lambda(a) + lambda(b)); }

  /// The facet at (q, phi) in (0, 1) x (0, 2 pi), where q^-2 - 1 is the squared slope in multiples
  /// of alpha: then the distribution, projected, has the density q / pi.
  glm::dvec3 facet(double q, double phi) const {
    double const slope = std::sqrt((1 - q) * (1 + q)) / q;
    return turned_back(
        glm::normalize(glm::dvec3(slope * x * std::cos(phi), slope * y * std::sin(phi), 1)));
  }
  glm::dvec2 place(glm::dvec3 m) const {
    glm::dvec3 const t = turned(m);
    glm::dvec2 const slope(t.x / t.z / x, t.y / t.z / y);
    double const phi = std::atan2(slope.y, slope.x);
    return {1 / std::hypot(1, glm::length(slope)), phi < 0 ? phi + 2 * exact_pi : phi};
  }
  /// Solid angle of facets per dq dphi.
  double measure(glm::dvec3 m, double q) const { return m.z * m.z * m.z * x * y / (q * q * q); }
  /// Density of the facets that are visible from `wo`, per dq dphi.
  double visible(glm::dvec3 wo, glm::dvec3 m, double q) const {
    return g1(wo) * std::max(glm::dot(wo, m), 0.0) / (m.z * wo.z) * q / exact_pi;
  }
};

inline glm::dvec3 exact_polar(double cos_theta, double phi) {
  double const r = std::sqrt((1 - cos_theta) * (1 + cos_theta));
  return {r * std::cos(phi), r * std::sin(phi), cos_theta};
}

/// Fresnel's reflectance of unpolarised light, and the cosine on the far side.
inline double exact_fresnel(double cos_i, double eta, double& cos_t) {
  long double const c = cos_i, n = eta, sin2_t = (1 - c) * (1 + c) / (n * n);
  cos_t = 0;
  if (sin2_t >= 1) return 1;
  long double const t = std::sqrt(1 - sin2_t);
  cos_t = static_cast<double>(t);
  long double const s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
  return static_cast<double>((s * s + p * p) / 2);
}

/// Point i of n in (0, 1) x (0, 2 pi), by the golden ratio.
inline glm::dvec2 place_in_lattice(int i, int n) {
  return {(i + 0.5) / n, 2 * exact_pi * glm::fract(i * 0.6180339887498949)};
}

/// The directions that facets turn `wo` to: by reflection, and where `eta` is given by refraction.
struct facet_map {
  exact_ggx shape;
  glm::dvec3 wo;
  double eta = 0;  ///< 0: nothing goes through

  glm::dvec3 reflected(glm::dvec3 m) const { return 2 * glm::dot(wo, m) * m - wo; }
  glm::dvec3 refracted(glm::dvec3 m) const {
    double cos_t;
    (void)exact_fresnel(glm::dot(wo, m), eta, cos_t);
    return cos_t > 0 ? (glm::dot(wo, m) / eta - cos_t) * m - wo / eta : glm::dvec3{0, 0, 1};
  }
  /// The facet that turns `wo` to `wi`.
  glm::dvec3 facet_between(glm::dvec3 wi) const {
    glm::dvec3 const m = glm::normalize(wi.z > 0 ? wo + wi : wo + eta * wi);
    return m.z < 0 ? -m : m;
  }
  /// Solid angle of `wi` per dq dphi.
  double measure(glm::dvec3 wi, glm::dvec3 m, double q) const {
    double const o = glm::dot(wo, m), i = glm::dot(wi, m), root = o + eta * i;
    return shape.measure(m, q) * (wi.z > 0 ? 4 * o : root * root / (eta * eta * std::abs(i)));
  }

  /// Calls f(wi, weight) such that the sum of weight * g(wi) is the integral of g over all
  /// directions: n facets and n directions all over, weighed against each other.
  template <class Function>
  void for_each_direction(int n, Function const& f) const {
    double const cell = 2 * exact_pi / n;
    for (int i = 0; i < n; ++i) {
      glm::dvec2 const at = place_in_lattice(i, n);
      glm::dvec3 const m = shape.facet(at.x, at.y);
      if (glm::dot(wo, m) > 0) {
        glm::dvec3 const up = reflected(m);
        if (up.z > 0) f(up, cell / (1 / measure(up, m, at.x) + 1));
        if (eta > 0)
          if (glm::dvec3 const down = refracted(m); down.z < 0)
            f(down, cell * measure(down, m, at.x));
      }
      glm::dvec3 const wi = exact_polar(at.x, at.y);
      glm::dvec3 const between = facet_between(wi);
      double const per_facet = measure(wi, between, shape.place(between).x);
      f(wi, cell / (1 / per_facet + 1));
    }
  }
};

}  // namespace path_tracer
