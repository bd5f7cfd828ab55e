// SPDX-License-Identifier: Apache-2.0
// Some shaders that become vectors, and some that cannot: test/vectors.py says which.
#include <thrust/system/cpp/execution_policy.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>

namespace ds = deferred_shade;

struct hit {
  float cosine;
  float distance;
};

void shade_all(std::size_t n, std::uint8_t const* ids, hit const* hits, float* radiance);
float of_another_file(float x);

namespace materials {

struct matte {
  float albedo;
  float operator()(hit const& h) const { return albedo * std::max(h.cosine, 0.0F); }
};

struct fog {
  float operator()(hit const& h) const { return std::exp(-h.distance); }
};

struct glass {
  float operator()(hit const& h) const { return of_another_file(h.cosine); }
};

template <class T>
__attribute__((noinline)) T rough(T x) {
  T sum = x;
  for (int i = 0; i < 9; ++i) sum = sum * x + T{0.5};
  return sum;
}
struct metal {
  float operator()(hit const& h) const { return rough(h.cosine) + rough(h.distance); }
};

struct marching {
  float operator()(hit const& h) const {
    float x = h.cosine;
    while (x < h.distance) x = x * x + 1;
    return x;
  }
};

template <int Layers>
struct lacquer {
  float operator()(hit const& h) const { return Layers * h.cosine; }
};

}  // namespace materials

void shade_all(std::size_t n, std::uint8_t const* ids, hit const* hits, float* radiance) {
  ds::workspace scratch{thrust::cpp::par};
  auto const mirror = [](hit const& h) { return h.distance * h.cosine; };
  ds::shade(thrust::cpp::par, ds::local_sort_then_dispatch<>{}, n, ids,
            ds::record_shaders(hits, radiance, materials::matte{0.8F}, materials::fog{},
                               materials::glass{}, materials::metal{}, materials::marching{},
                               materials::lacquer<3>{}, mirror),
            scratch);
}
