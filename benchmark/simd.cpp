// SPDX-License-Identifier: Apache-2.0
// What a compiler makes of a scalar shader in a loop over packed lanes, next to the same shader
// written for vectors by hand (std::experimental::simd, where the standard library has it): what
// decided that the library asks for no vector types. All records are in the first-level cache, and
// packed but for the scalar loop. Names: shader / way / n / run.
#include <deferred_shade/detail/cpu/lanes.hpp>

#include <cmath>
#include <cstring>
#include <vector>
#if __has_include(<experimental/simd>)
#if defined(__GNUC__) && !defined(__clang__)
// g++ 12 of its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <experimental/simd>
#endif

#include "axes.hpp"
#include "batch.hpp"

namespace {

namespace ds = deferred_shade;

struct microfacet_request {
  float light, view, half, difference, x, y;
};

/// The arithmetic of a microfacet lobe over value noise, for float or a vector of them. `Bits` is
/// the unsigned integer to go with it, `to_bits` and `to_float` convert whole numbers.
template <class Float, class Bits, class ToBits, class ToFloat>
Float stone(Float const (&q)[6], ToBits to_bits, ToFloat to_float) {
  using std::floor;
  using std::sqrt;
  auto const noise = [&](Float x, Float y, std::uint32_t seed) {
    Float const floor_x = floor(x);
    Float const floor_y = floor(y);
    Bits const cell_x = to_bits(floor_x);
    Bits const cell_y = to_bits(floor_y);
    auto const corner = [&](std::uint32_t right, std::uint32_t up) {
      Bits h = ((cell_x + right) * 0x9e3779b1U) ^ ((cell_y + up) * 0x85ebca77U) ^ Bits(seed);
      h ^= h >> 16;
      h *= 0x85ebca6bU;
      h ^= h >> 13;
      h *= 0xc2b2ae35U;
      h ^= h >> 16;
      return to_float(h >> 8) * 0x1p-24F;
    };
    Float const a = x - floor_x;
    Float const b = y - floor_y;
    Float const u = a * a * (3.0F - 2.0F * a);
    Float const v = b * b * (3.0F - 2.0F * b);
    Float const low = corner(0, 0) + u * (corner(1, 0) - corner(0, 0));
    Float const high = corner(0, 1) + u * (corner(1, 1) - corner(0, 1));
    return low + v * (high - low);
  };
  constexpr float alpha2 = 0.04F;
  auto const& [light, view, half, difference, x, y] = q;
  Float const colour = 0.5F * noise(x, y, 3) + 0.25F * noise(2.0F * x, 2.0F * y, 4);
  Float const d = half * half * (alpha2 - 1) + 1.0F;
  Float const toward = light * sqrt(view * view * (1 - alpha2) + alpha2);
  Float const away = view * sqrt(light * light * (1 - alpha2) + alpha2);
  Float const grazing = 1.0F - difference;
  Float const grazing2 = grazing * grazing;
  Float const fresnel = 0.04F + 0.96F * grazing2 * grazing2 * grazing;
  Float const distribution = alpha2 / (3.14159265F * d * d + 1e-7F);
  return colour * light + light * fresnel * distribution * 0.5F / (toward + away + 1e-6F);
}

float scalar_stone(microfacet_request const& r) {
  float const q[6] = {r.light, r.view, r.half, r.difference, r.x, r.y};
  return stone<float, std::uint32_t>(
      q, [](float x) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(x)); },
      [](std::uint32_t x) { return static_cast<float>(static_cast<std::int32_t>(x)); });
}

constexpr std::size_t lanes = 256;
using request_lanes = ds::detail::lanes<microfacet_request, lanes>;
using result_lanes = ds::detail::lanes<float, lanes>;

/// The library's way: g++ and clang make vectors of it. Lanes are local variables, as there.
__attribute__((flatten, noinline)) void run_loop(request_lanes const& from, result_lanes& to) {
  request_lanes const requests = from;
  result_lanes results;
  for (std::size_t j = 0; j < lanes; ++j) {
    microfacet_request const r = requests.get(j);
    results.set(j, scalar_stone(r));
  }
  to = results;
}

/// The same arrays for who loads vectors by hand.
struct planes {
  alignas(64) float request[6][lanes];
  alignas(64) float result[lanes];
};

#ifdef __cpp_lib_experimental_parallel_simd
namespace stdx = std::experimental;
__attribute__((flatten, noinline)) void run_vectors(planes& p) {
  using floats = stdx::native_simd<float>;
  using ints = stdx::rebind_simd_t<std::int32_t, floats>;
  using bits = stdx::rebind_simd_t<std::uint32_t, floats>;
  for (std::size_t j = 0; j < lanes; j += floats::size()) {
    floats q[6];
    for (int c = 0; c < 6; ++c) q[c].copy_from(p.request[c] + j, stdx::vector_aligned);
    floats const result = stone<floats, bits>(
        q, [](floats x) { return stdx::static_simd_cast<bits>(stdx::static_simd_cast<ints>(x)); },
        [](bits x) { return stdx::static_simd_cast<floats>(stdx::static_simd_cast<ints>(x)); });
    result.copy_to(p.result + j, stdx::vector_aligned);
  }
}
#endif

}  // namespace

int main(int argc, char** argv) {
  std::vector<microfacet_request> requests(lanes);
  for (std::size_t j = 0; j < lanes; ++j) {
    auto const random = [j](std::uint32_t d) {
      return bench::uniform(bench::random_bits(static_cast<ds::request_index>(j), d));
    };
    requests[j] = {random(0), random(1), random(2), random(3), 9 * random(4), 9 * random(5)};
  }
  return bench::run(argc, argv, [&](bool quick) {
    std::size_t const rounds = quick ? 16 : 4096;
    auto const add = [&](std::string const& way, auto run, auto result_of) {
      bench::add_cell("stone/" + way + bench::name_of(rounds * lanes, 1),
                      [=, &requests](benchmark::State& state) {
                        run();
                        bool right = true;
                        for (std::size_t j = 0; j < lanes; ++j) {
                          float const expected = scalar_stone(requests[j]);
                          float const got = result_of(j);
                          right = right && std::memcmp(&expected, &got, sizeof got) == 0;
                        }
                        if (!bench::check(state, right)) return;
                        bench::measure(state, rounds * lanes, [&] {
                          for (std::size_t round = 0; round < rounds; ++round) run();
                        });
                      });
    };
    static request_lanes packed;
    static result_lanes results;
    static planes by_hand;
    for (std::size_t j = 0; j < lanes; ++j) {
      packed.set(j, requests[j]);
      for (std::size_t c = 0; c < 6; ++c) {
        std::memcpy(&by_hand.request[c][j], reinterpret_cast<float const*>(&requests[j]) + c, 4);
      }
    }
    add(
        "scalar",
        [&requests] {
          for (std::size_t j = 0; j < lanes; ++j) {
            float volatile* const out = &by_hand.result[j];
            *out = scalar_stone(requests[j]);
          }
        },
        [](std::size_t j) { return by_hand.result[j]; });
    add(
        "compiler", [] { run_loop(packed, results); },
        [](std::size_t j) { return results.get(j); });
#ifdef __cpp_lib_experimental_parallel_simd
    add(
        "by-hand", [] { run_vectors(by_hand); }, [](std::size_t j) { return by_hand.result[j]; });
#endif
  });
}
