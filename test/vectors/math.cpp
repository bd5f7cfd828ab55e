// SPDX-License-Identifier: Apache-2.0
// Each function of math.hpp in a record shader: of a number that nothing is known of, and of one
// that std::max, std::min or both have bounded. All of them become vectors.
#include <thrust/system/cpp/execution_policy.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <deferred_shade/math.hpp>

namespace ds = deferred_shade;

struct request {
  float x;
  float y;
};

void shade_all(std::size_t n, std::uint8_t const* ids, request const* requests, float* results);

// Arguments.
struct any {
  static float of(float x) { return x; }
};
struct positive {
  static float of(float x) { return std::max(x, 0.0F); }
};
struct small {
  static float of(float x) { return std::min(x, 1.0F); }
};
struct bounded {
  static float of(float x) { return std::min(std::max(x, 0.0F), 1.0F); }
};

// Shaders.
template <class X>
struct exp_of {
  float operator()(request const& r) const { return ds::math::exp(X::of(r.x)); }
};
template <class X>
struct log_of {
  float operator()(request const& r) const { return ds::math::log(X::of(r.x)); }
};
template <class X>
struct pow_of {
  float operator()(request const& r) const { return ds::math::pow(X::of(r.x), r.y); }
};
template <class X>
struct sin_of {
  float operator()(request const& r) const { return ds::math::sin(X::of(r.x)); }
};
template <class X>
struct cos_of {
  float operator()(request const& r) const { return ds::math::cos(X::of(r.x)); }
};
struct glossy {
  float exponent;
  float operator()(request const& r) const { return ds::math::pow(std::max(r.x, 0.0F), exponent); }
};
struct attenuated {
  float operator()(request const& r) const {
    return ds::math::exp(-std::max(r.x, 0.0F)) * ds::math::pow(std::max(r.y, 0.0F), 2.2F);
  }
};

template <class... Shader>
void shade(std::size_t n, std::uint8_t const* ids, request const* requests, float* results,
           Shader... shaders) {
  ds::workspace scratch{thrust::cpp::par};
  ds::shade(thrust::cpp::par, ds::local_sort_then_dispatch<>{}, n, ids,
            ds::record_shaders(requests, results, shaders...), scratch);
}
template <class X>
void shade_with(std::size_t n, std::uint8_t const* ids, request const* requests, float* results) {
  shade(n, ids, requests, results, exp_of<X>{}, log_of<X>{}, pow_of<X>{}, sin_of<X>{}, cos_of<X>{});
}

void shade_all(std::size_t n, std::uint8_t const* ids, request const* requests, float* results) {
  shade_with<any>(n, ids, requests, results);
  shade_with<positive>(n, ids, requests, results);
  shade_with<small>(n, ids, requests, results);
  shade_with<bounded>(n, ids, requests, results);
  shade(n, ids, requests, results, glossy{20}, attenuated{});
}
