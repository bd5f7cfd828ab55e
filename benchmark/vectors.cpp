// SPDX-License-Identifier: Apache-2.0
// What regrouping gains on CPUs where shaders can run in vectors: materials of a hundred operations
// and more, 12 floats in and 3 out, without a branch or a call. Every schedule that runs records in
// vectors, and as controls `implicit`, requests as they come through the switch, and batches of one
// material, which need no grouping. The names of cells are those of benchmark_schedules. The
// runtime says how many threads work: OpenMP by OMP_NUM_THREADS.
#include <cmath>
#include <cstring>
#include <deferred_shade/math.hpp>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "axes.hpp"
#include "batch.hpp"

namespace {

namespace ds = deferred_shade;
namespace math = ds::math;
using bench::operator""_mi;

struct surface {
  float position[3];
  float normal[3];
  float view[3];
  float light[3];
};
struct radiance {
  float rgb[3];
};
static_assert(sizeof(surface) == 48 && sizeof(radiance) == 12);

float dot(float const* a, float const* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
float positive(float x) { return x > 0 ? x : 0; }

/// Value noise in two dimensions: hashed corners, blended by smooth steps.
float noise(float x, float y, std::uint32_t seed) {
  float const floor_x = std::floor(x);
  float const floor_y = std::floor(y);
  auto const cell_x = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor_x));
  auto const cell_y = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor_y));
  auto const corner = [=](std::uint32_t right, std::uint32_t up) {
    std::uint32_t const bits =
        bench::mixed((cell_x + right) * 0x9e3779b1U ^ (cell_y + up) * 0x85ebca77U ^ seed);
    return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24F;
  };
  auto const smooth = [](float t) { return t * t * (3 - 2 * t); };
  float const u = smooth(x - floor_x);
  float const v = smooth(y - floor_y);
  float const low = corner(0, 0) + u * (corner(1, 0) - corner(0, 0));
  float const high = corner(0, 1) + u * (corner(1, 1) - corner(0, 1));
  return low + v * (high - low);
}

/// Noise of `Octaves` frequencies, each twice the one before and half as strong. Unrolled by the
/// language: g++ makes no vectors of a loop around a loop.
template <int Octaves>
float turbulence(float x, float y, std::uint32_t seed) {
  if constexpr (Octaves == 0) {
    return 0;
  } else {
    return 0.5F * (noise(x, y, seed) + turbulence<Octaves - 1>(2 * x, 2 * y, seed + 1));
  }
}

/// The cosines that a material is made of.
struct angles {
  float light;       ///< light and normal
  float view;        ///< view and normal
  float half;        ///< half vector and normal
  float difference;  ///< half vector and view

  explicit angles(surface const& s)
      : light(positive(dot(s.normal, s.light))), view(positive(dot(s.normal, s.view))) {
    float const h[3] = {s.view[0] + s.light[0], s.view[1] + s.light[1], s.view[2] + s.light[2]};
    float const scale = 1 / std::sqrt(dot(h, h) + 1e-8F);
    half = positive(dot(s.normal, h) * scale);
    difference = positive(dot(s.view, h) * scale);
  }
};

/// Trowbridge and Reitz's microfacets, with Smith's shadowing and Schlick's Fresnel term.
float microfacets(angles const& a, float alpha) {
  float const alpha2 = alpha * alpha;
  float const d = a.half * a.half * (alpha2 - 1) + 1;
  float const toward = a.light * std::sqrt(a.view * a.view * (1 - alpha2) + alpha2);
  float const away = a.view * std::sqrt(a.light * a.light * (1 - alpha2) + alpha2);
  float const grazing = 1 - a.difference;
  float const grazing2 = grazing * grazing;
  float const fresnel = 0.04F + 0.96F * grazing2 * grazing2 * grazing;
  float const distribution = alpha2 / (3.14159265F * d * d + 1e-7F);
  return a.light * fresnel * distribution * 0.5F / (toward + away + 1e-6F);
}

/// Stone, wax, stripes or marble, each of its own grain and roughness.
template <int Id>
struct material {
  radiance operator()(surface const& s) const {
    constexpr float alpha = 0.05F + 0.05F * (1 + Id % 16);
    constexpr float grain = 3 + Id % 8;
    constexpr std::uint32_t seed = 71 * Id + 3;
    angles const a(s);
    if constexpr (Id % 4 == 0) {
      float const stone = turbulence<2>(grain * s.position[0], grain * s.position[1], seed);
      return shaded(a, stone, 0.8F * stone, 0.3F * stone, microfacets(a, alpha));
    } else if constexpr (Id % 4 == 1) {
      float const wax = turbulence<4>(grain * s.position[0], grain * s.position[2], seed);
      float const deep = math::exp(-alpha * (std::fabs(s.position[0]) + wax));
      return shaded(a, wax * deep, deep, (1 - wax) * deep, 0.02F * a.half);
    } else if constexpr (Id % 4 == 2) {
      float const bent = grain * s.position[0] + 2 * math::sin(grain * s.position[1]);
      float const stripe = 0.5F + 0.5F * math::sin(bent);
      return shaded(a, stripe, 1 - stripe, 0.2F, microfacets(a, alpha));
    } else {
      float const rough = turbulence<4>(grain * s.position[0], grain * s.position[1], seed);
      float const vein = 0.5F + 0.5F * math::sin(grain * s.position[2] + 5 * rough);
      float const dark = math::exp(-2 * vein);
      return shaded(a, vein, vein * dark, dark, microfacets(a, alpha));
    }
  }

 private:
  static radiance shaded(angles const& a, float r, float g, float b, float gloss) {
    return {{r * a.light + gloss, g * a.light + gloss, b * a.light + gloss}};
  }
};

surface make_surface(ds::request_index i) {
  surface s;
  std::uint32_t dimension = 20;
  for (float* v : {s.position, s.normal, s.view, s.light}) {
    for (int d = 0; d < 3; ++d) v[d] = 2 * bench::uniform(bench::random_bits(i, dimension++)) - 1;
    float const scale = v == s.position ? 5 : 1 / std::sqrt(dot(v, v) + 1e-6F);
    for (int d = 0; d < 3; ++d) v[d] *= scale;
  }
  return s;
}

/// The requests of one cell, and what comes out.
struct batch {
  std::vector<surface> surfaces;
  std::vector<std::uint8_t> ids;
  std::vector<radiance> expected;
  std::vector<radiance> results;

  template <int... Ids>
  batch(std::size_t n, std::uint32_t run, std::integer_sequence<int, Ids...>)
      : surfaces(n), ids(n), expected(n), results(n) {
    auto const made = bench::make_ids(n, sizeof...(Ids), run);
    thrust::copy(made.begin(), made.end(), ids.begin());
    for (std::size_t i = 0; i < n; ++i) {
      surfaces[i] = make_surface(static_cast<ds::request_index>(i));
      ((ids[i] == Ids ? void(expected[i] = material<Ids>{}(surfaces[i])) : void()), ...);
    }
  }

  template <int... Ids>
  auto table(std::integer_sequence<int, Ids...>) {
    return ds::record_shaders(static_cast<surface const*>(surfaces.data()), results.data(),
                              material<Ids>{}...);
  }

  /// The means of the results, for programs that do the same.
  void add_means(benchmark::UserCounters& counters) const {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (radiance const& r : results) sum += static_cast<double>(r.rgb[c]);
      counters[std::string("mean_") + "rgb"[c]] = sum / static_cast<double>(results.size());
    }
  }

  void clear() { std::fill(results.begin(), results.end(), radiance{{-1, -1, -1}}); }
  bool is_right() const {
    return std::memcmp(results.data(), expected.data(), results.size() * sizeof(radiance)) == 0;
  }
};

/// The batch of the cells that are running.
struct current_batch {
  std::string name;
  std::unique_ptr<batch> made;
};

template <int Materials>
void add_set(current_batch& current, std::size_t n, std::uint32_t run) {
  using ids = std::make_integer_sequence<int, Materials>;
  std::string const set = std::to_string(Materials) + " materials";
  std::string const end = bench::name_of(n, run);
  auto const add = [&](std::string const& row, auto schedule) {
    auto const cell = [&current, n, run, schedule, name = set + end](benchmark::State& state) {
      if (current.name != name) {
        current.made.reset();
        current.made = std::make_unique<batch>(n, run, ids());
        current.name = name;
      }
      batch& w = *current.made;
      auto const shade = [&] {
        ds::shade(bench::policy(), schedule, n, w.ids.data(), w.table(ids()), bench::scratch());
      };
      w.clear();
      shade();
      if (!bench::check(state, w.is_right())) return;
      bench::measure(state, n, shade);
      w.add_means(state.counters);
    };
    bench::add_cell(set + "/record/" + row + end, cell);
  };
  add("implicit", ds::implicit_serialization{});
  add("sort+explicit", ds::sort_then_dispatch<>{});
  add("bucket+explicit", ds::bucket_then_dispatch<>{});
  add("local", ds::local_sort_then_dispatch<>{});
  add("window", ds::window_sort_then_dispatch{});
}

}  // namespace

int main(int argc, char** argv) {
  current_batch current;
  return bench::run(argc, argv, [&](bool quick) {
    std::vector<std::size_t> const sizes =
        quick ? std::vector{1_mi / 32} : std::vector{1_mi / 8, 4_mi};
    for (std::size_t const n : sizes) {
      for (std::uint32_t const run : {1U, 32U, 512U}) {
        add_set<1>(current, n, run);
        add_set<4>(current, n, run);
        add_set<12>(current, n, run);
      }
    }
  });
}
