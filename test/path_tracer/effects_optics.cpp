// SPDX-License-Identifier: Apache-2.0
// Effects of glass, films and brushed surfaces against what is known of them in closed form.
#include <cmath>
#include <complex>

#include "machines.hpp"
#include "shading/spectrum.hpp"
#include "shading/thin_film.hpp"

using namespace path_tracer;

namespace {

double const tau = 2 * std::acos(-1.0);

/// The reflectance of one layer by characteristic matrices (Born and Wolf, section 1.6).
double by_matrices(double cos0, double wavelength, double n1, double thickness, double n2) {
  double const sin0 = std::sqrt(1 - cos0 * cos0);
  double const cos1 = std::cos(std::asin(sin0 / n1)), cos2 = std::cos(std::asin(sin0 / n2));
  double const beta = tau * n1 * thickness * cos1 / wavelength;
  std::complex<double> const i(0, 1);
  double sum = 0;
  for (bool const s : {true, false}) {
    double const p0 = s ? cos0 : 1 / cos0, p1 = s ? n1 * cos1 : n1 / cos1,
                 p2 = s ? n2 * cos2 : n2 / cos2;
    std::complex<double> const a = std::cos(beta), b = -i * std::sin(beta) / p1,
                               c = -i * p1 * std::sin(beta);
    std::complex<double> const above = (a + b * p2) * p0, below = c + a * p2;
    sum += 0.5 * std::norm((above - below) / (above + below));
  }
  return sum;
}

/// One path and the glass that it meets, as effects see them.
struct glass_batch {
  float* wavelength;
  vec3* origin;
  vec3* throughput;
  std::uint32_t number;

  template <class Effect>
  float& state(std::uint32_t i) const {
    return wavelength[i];
  }
  random_stream random(std::uint32_t) const { return {3, number, 0}; }
};
struct glass_point {
  path_tracer::material material;
  float ior = 0;
};

}  // namespace

TEST_CASE("a slab of coloured glass dims light by Beer and Lambert's law", "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s;
  s.materials.resize(2);
  material& glass = s.materials[0];
  glass.kind = shader_of<effects::smooth_glass>;
  glass.base_color = vec3{1};
  glass.roughness = 0;
  glass.transmission = 1;
  glass.thickness = 1;
  glass.attenuation_color = {0.8f, 0.4f, 0.1f};
  glass.attenuation_distance = 0.7f;
  effects::absorption::prepare(glass);
  s.materials[1].kind = shader_of<effects::emitters>;
  s.materials[1].emission = vec3{1};
  s.materials[1].base_color = vec3{0};
  double const thickness = 0.5;
  add_box(s, {0, 0, -1}, {20, 20, static_cast<float>(thickness / 2)}, 0, false);
  add_quad(s, {-50, -50, -3}, {100, 0, 0}, {0, 100, 0}, 1);
  s.view.position = {0, 0, 1};
  s.view.tan_half_yfov = 1e-3f;
  render_result const r = render(s, small(256, 40, machine));
  for (int c = 0; c < 3; ++c) {
    // With all reflections inside, of which each loses on its way.
    double const f = 0.04, t = std::pow(double{glass.attenuation_color[c]}, thickness / 0.7),
                 expected = (1 - f) * (1 - f) * t / (1 - f * f * t * t);
    glm::dvec2 const mean = mean_and_error(r, c);
    CAPTURE(c, expected, mean.x, mean.y);
    CHECK_THAT(mean.x, WithinAbs(expected, mean.y));
    CHECK(mean.y < 0.01);
  }
}

TEST_CASE("a dispersive glass has the Abbe number that the file states", "[effects]") {
  for (float const ior : {1.3f, 1.52f, 2.42f})
    for (float const dispersion : {0.1f, 0.36f, 2.0f}) {
      CAPTURE(ior, dispersion);
      double const d = double{effects::dispersive_ior(ior, dispersion, 587.56f)},
                   f = double{effects::dispersive_ior(ior, dispersion, 486.13f)},
                   c = double{effects::dispersive_ior(ior, dispersion, 656.27f)};
      CHECK_THAT(d, WithinAbs(double{ior}, 1e-4));
      CHECK_THAT((d - 1) / (f - c), WithinRel(20 / double{dispersion}, 2e-3));
    }
}

TEST_CASE("wavelengths add up to white", "[effects]") {
  glm::dvec3 sum(0);
  int const count = 100000;
  for (int k = 0; k < count; ++k) {
    vec3 const color = color_of(sample_wavelength((static_cast<float>(k) + 0.5f) / count));
    CHECK(glm::all(glm::greaterThanEqual(color, vec3{0})));
    sum += glm::dvec3(color);
  }
  for (int c = 0; c < 3; ++c) CHECK_THAT(sum[c] / count, WithinAbs(1, 1e-4));
}

TEST_CASE("a path keeps the wavelength that its first dispersive glass gave it", "[effects]") {
  glass_point point{};
  point.material.ior = 1.6f;
  for (std::uint32_t k = 0; k < 200; ++k) {
    float wavelength = 0;
    vec3 origin{0}, throughput{1};
    glass_batch const batch{&wavelength, &origin, &throughput, k};
    point.material.dispersion = 0;
    point.ior = 1.6f;
    effects::dispersion::at_glass(batch, 0, point);
    REQUIRE(wavelength == 0);
    REQUIRE(point.ior == 1.6f);
    point.material.dispersion = 1;
    for (int hit = 0; hit < 3; ++hit) {
      effects::dispersion::at_glass(batch, 0, point);
      REQUIRE(wavelength >= shortest_wavelength);
      REQUIRE(wavelength < longest_wavelength);
      REQUIRE(throughput == color_of(wavelength));
      REQUIRE(point.ior == effects::dispersive_ior(1.6f, 1, wavelength));
      // Snell's law for that colour, in double.
      bsdf_smooth_glass const glass{vec3{1}, point.ior};
      vec3 const wo = polar(std::cos(0.7f), 0.3f);
      bsdf_sample const b = glass.sample(wo, {0, 0, 0.999f});
      double const sine2 =
          (1 - double{wo.z} * double{wo.z}) / (double{point.ior} * double{point.ior});
      REQUIRE_THAT(double{b.wi.z}, WithinAbs(-std::sqrt(1 - sine2), 1e-6));
    }
  }
}

TEST_CASE("white glass that bends colours vanishes in an even sky", "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s;
  s.background = vec3{0.5f};
  s.view.position = {0.3f, 0.4f, 4};
  material m;
  m.kind = shader_of<effects::smooth_glass>;
  m.base_color = vec3{1};
  m.roughness = 0;
  m.transmission = 1;
  m.dispersion = 1;
  s.materials = {m};
  add_box(s, {0, 0, 0}, vec3{1}, 0, false);
  render_result const r = render(s, small(256, 200, machine));
  for (int c = 0; c < 3; ++c) {
    glm::dvec2 const mean = mean_and_error(r, c);
    CAPTURE(c);
    CHECK_THAT(mean.x, WithinAbs(0.5, mean.y + 1e-3));
    CHECK(mean.y < 0.02);
  }
}

TEST_CASE("a thin film reflects what Airy's formula and matrices say", "[effects]") {
  for (double const film : {1.0, 1.3, 1.6, 2.4})
    for (double const base : {1.2, 1.5, 4.0})
      for (double const thickness : {0.0, 80.0, 400.0, 2000.0})
        for (double const wavelength : {400.0, 550.0, 700.0}) {
          CAPTURE(film, base, thickness, wavelength);
          // At normal incidence the amplitudes of both interfaces, in the closed form of Airy.
          double const a = (1 - film) / (1 + film), b = (film - base) / (film + base),
                       c = std::cos(2 * tau * film * thickness / wavelength);
          double const airy = (a * a + b * b + 2 * a * b * c) / (1 + a * a * b * b + 2 * a * b * c);
          CHECK_THAT(film_reflectance_at(1, wavelength, film, thickness, base),
                     WithinAbs(airy, 1e-12));
          for (double const cosine : {0.02, 0.3, 0.7, 0.99})
            CHECK_THAT(film_reflectance_at(cosine, wavelength, film, thickness, base),
                       WithinAbs(by_matrices(cosine, wavelength, film, thickness, base), 1e-12));
        }
}

TEST_CASE("limits of a thin film", "[effects]") {
  double const base = 1.5, quarter = 550 / (4 * std::sqrt(base));
  // A quarter wave of the geometric mean cancels its colour; half a wave is not there.
  CHECK_THAT(film_reflectance_at(1, 550, std::sqrt(base), quarter, base), WithinAbs(0, 1e-15));
  CHECK_THAT(film_reflectance_at(1, 550, 1.3, 550 / (2 * 1.3), base), WithinAbs(0.04, 1e-12));
  film_reflectance const none = reflectance_of_film(1.3, 0, vec3{0.04f, 0.2f, 0.6f});
  CHECK_THAT(none(1).x, WithinAbs(0.04, 1e-5));
  CHECK_THAT(none(1).y, WithinAbs(0.2, 1e-5));
  CHECK_THAT(none(1).z, WithinAbs(0.6, 1e-5));
  CHECK_THAT(none(0).y, WithinAbs(1, 1e-4));
  // No value is NaN without a film, or with nothing below the film.
  for (float const film : {1.0f, 1.3f})
    for (float const thickness : {0.0f, 400.0f})
      for (float const f0 : {0.0f, 0.04f, 1.0f})
        for (vec3 const& v : reflectance_of_film(film, thickness, vec3{f0}).values) {
          CAPTURE(film, thickness, f0);
          REQUIRE(v.x >= 0);
          REQUIRE(v.x <= 1 + 1e-6f);
        }
  // The table is the mean over wavelengths, here by another rule, at places between its own.
  film_reflectance const oil = reflectance_of_film(1.4, 500, vec3{0.04f});
  for (float const cosine : {0.5f, 0.515625f, 0.8f, 1.0f}) {
    glm::dvec3 sum(0), weights(0);
    for (int k = 0; k <= 3000; ++k) {
      float const wavelength = 400 + 0.1f * static_cast<float>(k);
      glm::dvec3 const color(signed_color_of(wavelength));
      sum += color * film_reflectance_at(double{cosine}, double{wavelength}, 1.4, 500, 1.5);
      weights += color;
    }
    for (int c = 0; c < 3; ++c) {
      CAPTURE(cosine, c);
      CHECK_THAT(double{oil(cosine)[c]}, WithinAbs(sum[c] / weights[c], 1e-3));
    }
  }
}

TEST_CASE("the colour of a film is clipped as a whole, not at each wavelength", "[effects]") {
  // A film that is green and blue at some wavelengths takes red light away from the sum: by the
  // colour matching functions, 0.4325 is left of red at 350 nm, and 0.33 with clipped wavelengths.
  vec3 const f0{0.36f};  // of the index 4
  CHECK_THAT(reflectance_of_film(1.8f, 350, f0)(1).x, WithinAbs(0.4325, 2e-3));
}

TEST_CASE("a brushed lobe is as wide as its two roughnesses, along its axes", "[effects]") {
  float const angle = 0.6f;
  turned_ggx const lobe{0.5f, 0.1f, std::cos(angle), std::sin(angle)};
  ggx const round{0.3f};
  turned_ggx const same{0.3f, 0.3f, std::cos(angle), std::sin(angle)};
  // Where the tangent is the roughness, the density over its peak is 1 / (4 cos^4).
  for (int axis = 0; axis < 2; ++axis) {
    float const theta = std::atan(axis == 0 ? 0.5f : 0.1f), phi = angle + float(axis) * pi / 2;
    double const cosine = std::cos(double{theta});
    CHECK_THAT(double{lobe.d(polar(std::cos(theta), phi)) / lobe.d({0, 0, 1})},
               WithinRel(1 / (4 * cosine * cosine * cosine * cosine), 1e-4));
  }
  double area = 0;
  int const steps = 1000;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      double const z = (i + 0.5) / steps, phi = tau * (j + 0.5) / steps;
      vec3 const m = polar(static_cast<float>(z), static_cast<float>(phi));
      area += double{lobe.d(m)} * z * tau / (steps * steps);
      if (i % 97 == 0 && j % 89 == 0) {
        CHECK_THAT(same.d(m), WithinRel(round.d(m), 1e-4f));
        CHECK_THAT(same.lambda(m), WithinRel(round.lambda(m), 1e-3f));
      }
    }
  CHECK_THAT(area, WithinAbs(1, 1e-3));
}
