// SPDX-License-Identifier: Apache-2.0
// Every BSDF on the device against itself on the host, from roughness 0 to 1 and down to cosines of
// 1e-6. The two differ by the rounding of sine, cosine, power and exponential.
#include <thrust/for_each.h>
#include <algorithm>
#include <vector>

#include "../bsdf_support.hpp"
#include "../hard_support.hpp"
#include "device_support.hpp"
#include "white_bsdfs.hpp"

using namespace path_tracer;

namespace {

struct input {
  vec3 wo, u, wi;  ///< `wi` for value()
};
struct output {
  bsdf_sample sample;
  bsdf_value value;
};

template <class Make>
struct evaluate {
  Make make;
  lookups at;
  input const* in;
  output* out;
  PT_HD void operator()(std::uint32_t i) const {
    auto const b = make(at);
    out[i] = {b.sample(in[i].wo, in[i].u), b.value(in[i].wo, in[i].wi)};
  }
};

constexpr std::uint32_t inputs = 1000000;

/// Half of the cosines are uniform, half uniform in their logarithm; numbers as a path draws them.
std::vector<input> random_inputs(std::uint64_t seed) {
  fine_numbers n(seed);
  std::vector<input> result(inputs);
  for (std::uint32_t i = 0; i < inputs; ++i) {
    double const c = i % 2 == 0 ? n.over_decades(1e-6, 1) : 1e-6 + (1 - 1e-6) * n.uniform();
    random_stream const numbers(seed, i, 0);
    vec2 const first = numbers.pair(0);
    result[i].wo = polar(static_cast<float>(c), static_cast<float>(6.28 * n.uniform()));
    result[i].u = {first.x, first.y, numbers.pair(1).x};
  }
  return result;
}

double off(vec3 a, vec3 b) {
  glm::dvec3 const d = glm::abs(glm::dvec3(a) - glm::dvec3(b));
  return std::max({d.x, d.y, d.z});
}
bool is_near(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::max(a, b) + 1e-30;
}
bool is_near(vec3 a, vec3 b, double tolerance) {
  return is_near(double{a.x}, double{b.x}, tolerance) &&
         is_near(double{a.y}, double{b.y}, tolerance) &&
         is_near(double{a.z}, double{b.z}, tolerance);
}
/// A direction, whose length a half vector counts twice, and shares of light that are numbers.
bool is_sane(output const& o) {
  double const length = glm::length(glm::dvec3(o.sample.wi));
  vec3 const all = o.sample.weight + o.value.f_cos + vec3{o.sample.pdf + o.value.pdf};
  return std::abs(length - 1) < 2e-6 && std::isfinite(all.x + all.y + all.z) &&
         glm::all(glm::greaterThanEqual(o.sample.weight, vec3{0})) &&
         glm::all(glm::greaterThanEqual(o.value.f_cos, vec3{0})) && o.sample.pdf >= 0 &&
         o.value.pdf >= 0;
}

/// What a sample's weight and density may be off, relative. The half vector of two directions in
/// float is noise of 6e-8 over its length, which a lobe feels in multiples of alpha, and its
/// masking feels that of the cosine.
double slack_of(bsdf_sample const& s, vec3 wo, double alpha, double eta) {
  glm::dvec3 const a(wo), b(s.wi);
  double const half = s.delta ? 1 : glm::length(b.z > 0 ? a + b : a + eta * b);
  return 1e-4 + 1e-6 * (1 / (alpha * half) + 1 / std::abs(b.z));
}

struct comparison {
  double insane = 0;        ///< outputs that are not finite, not a direction, or negative
  double other_values = 0;  ///< value() that is off by more than 1e-5, relative
  double other_ways = 0;    ///< share of samples that go another way, or weigh something else
  double strict = 0;        ///< share of samples whose weight may be off by less than a hundredth
  double here = 0, there = 0;  ///< mean weight on host and device
};

template <class Make>
comparison compare(Make const& make, std::vector<input> in, material const& oil, double eta = 1.5) {
  std::vector<output> host(inputs), device(inputs);
  lookups const at{tables(), &oil};
  for (input& x : in) {
    bsdf_sample const s = make(at).sample(x.wo, x.u);
    x.wi = s.pdf > 0 ? s.wi : polar(x.u.y, 6.28f * x.u.x);
  }
  evaluate<Make> const on_host{make, at, in.data(), host.data()};
  for (std::uint32_t i = 0; i < inputs; ++i) on_host(i);

  thrust::device_vector<albedo_tables> const their_tables(1, *tables());
  thrust::device_vector<material> const their_oil(1, oil);
  thrust::device_vector<input> const their_in(in.begin(), in.end());
  thrust::device_vector<output> their_out(inputs, output{});
  auto const first = thrust::counting_iterator<std::uint32_t>(0);
  thrust::for_each(thrust::device, first, first + inputs,
                   evaluate<Make>{make,
                                  {thrust::raw_pointer_cast(their_tables.data()),
                                   thrust::raw_pointer_cast(their_oil.data())},
                                  thrust::raw_pointer_cast(their_in.data()),
                                  thrust::raw_pointer_cast(their_out.data())});
  thrust::copy(their_out.begin(), their_out.end(), device.begin());

  comparison c;
  double const alpha = double{alpha_of(make.roughness)}, one = 1.0 / inputs;
  for (std::uint32_t i = 0; i < inputs; ++i) {
    output const &a = host[i], &b = device[i];
    c.insane += is_sane(b) ? 0 : 1;
    c.other_values += is_near(a.value.f_cos, b.value.f_cos, 1e-5) &&
                              is_near(double{a.value.pdf}, double{b.value.pdf}, 1e-5)
                          ? 0
                          : 1;
    double const slack = slack_of(a.sample, in[i].wo, alpha, eta);
    bool const same = a.sample.delta == b.sample.delta && off(a.sample.wi, b.sample.wi) < 2e-5 &&
                      is_near(a.sample.weight, b.sample.weight, slack) &&
                      is_near(double{a.sample.pdf}, double{b.sample.pdf}, slack);
    c.other_ways += same ? 0 : one;
    c.strict += slack < 1e-2 ? one : 0;
    c.here += double{max_component(a.sample.weight)} * one;
    c.there += double{max_component(b.sample.weight)} * one;
  }
  return c;
}

void check(char const* name, float roughness, comparison const& c) {
  CAPTURE(name, roughness, c.other_ways, c.strict, c.here, c.there);
  CHECK(c.insane == 0);
  CHECK(c.other_values == 0);
  CHECK(c.other_ways < 5e-4);
  CHECK(c.strict > 0.5);
  CHECK_THAT(c.there, WithinAbs(c.here, 1e-4));
  CHECK(c.there <= 1 + 1e-3);
  CHECK(c.there > 0.1);
}

}  // namespace

TEST_CASE("BSDFs on the device are those of the host at the ends of their range", "[hard]") {
  std::uint64_t const seed = 741;
  std::vector<input> const in = random_inputs(seed);
  CAPTURE(seed);
  for (float const r : {0.0f, 1e-4f, 1e-2f, 0.1f, 0.5f, 1.0f}) {
    material oil = oily(r, 350, 0);
    check("metal", r, compare(white_metal{r}, in, oil));
    check("plastic", r, compare(plain_plastic{r}, in, oil));
    check("glass", r, compare(rough_glass{r, 1.5f}, in, oil));
    check("glass from inside", r, compare(rough_glass{r, 1 / 1.5f}, in, oil, 1 / 1.5));
    check("some transmission", r, compare(some_transmission{r}, in, oil));
    check("clearcoat", r, compare(varnished{r}, in, oil));
    check("sheen", r, compare(fuzzy{r}, in, oil));
    check("oily plastic", r, compare(oily_plastic{r}, in, oil));
    check("brushed metal", r, compare(brushed_metal{r}, in, oil));
    check("brushed plastic", r, compare(brushed_plastic{r}, in, oil));
  }
  material const oil;
  check("matte", 1, compare(white_matte{1}, in, oil));
  check("smooth glass", 1, compare(smooth_glass{1, 1.5f}, in, oil));
  check("smooth glass from inside", 1, compare(smooth_glass{1, 1 / 1.5f}, in, oil));
}
