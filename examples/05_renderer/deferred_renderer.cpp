// SPDX-License-Identifier: Apache-2.0
// A small wavefront path tracer: RENDERER PICTURE.pfm [SEED [furnace]]. The batch holds a path for
// each pixel, in arrays; a step intersects all paths that go on, then shades each by the material
// that it hit.
#include <thrust/execution_policy.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deferred_shade/deferred_shade.hpp>
#include <string>
#include <vector>

#include "picture.hpp"
#include "scene.hpp"
#include "vec.hpp"

namespace ds = deferred_shade;

namespace {

constexpr std::uint32_t width = 320, height = 240, size = width * height, samples = 8;
constexpr std::uint32_t longest = 1000;  // path, in steps

struct hit {
  vec point, normal;  // the normal points out of the object
  object const* surface;
};

struct renderer {
  scene world;
  std::vector<ray> rays = std::vector<ray>(size);
  std::vector<hit> hits = std::vector<hit>(size);
  std::vector<material> materials = std::vector<material>(size);  // of the hits
  std::vector<vec> throughput = std::vector<vec>(size);
  std::vector<vec> radiance = std::vector<vec>(size);  // summed over samples
  std::vector<std::uint64_t> rng = std::vector<std::uint64_t>(size);
  std::vector<std::uint8_t> alive = std::vector<std::uint8_t>(size);
  ds::workspace<> scratch;
};

// Knuth's linear congruential generator for MMIX: a number in [0, 1) from its highest bits.
float uniform(std::uint64_t& state) {
  state = 6364136223846793005U * state + 1442695040888963407U;
  return static_cast<float>(state >> 40) * 0x1p-24F;
}

template <class Function>
void for_each_path(Function const& f) {
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic, 1024)
#endif
  for (std::uint32_t i = 0; i < size; ++i) f(i);
}

void start(renderer& r, std::uint32_t i, std::uint32_t sample, std::uint32_t seed) {
  std::uint64_t& rng = r.rng[i] = (std::uint64_t{seed} << 32) + sample * size + i;
  for (int k = 0; k < 3; ++k) rng = (rng ^ (rng >> 32)) * 0x9e3779b97f4a7c15U;  // far apart
  float const x = static_cast<float>(i % width) + uniform(rng) - 0.5F * width;
  float const y = static_cast<float>(i / width) + uniform(rng) - 0.5F * height;
  r.rays[i] = {{0, 2, 8}, unit({x, y, -1.2F * height})};
  r.throughput[i] = {1, 1, 1};
  r.alive[i] = 1;
}

bool any_alive(renderer const& r) {
  return std::find(r.alive.begin(), r.alive.end(), 1) != r.alive.end();
}

void intersect(renderer& r, std::uint32_t i) {
  r.materials[i] = ended;
  if (!r.alive[i]) return;
  float t = 0;
  object const& o = r.world.first_hit(r.rays[i], t);
  vec const point = r.rays[i].origin + t * r.rays[i].direction;
  vec const normal = o.radius > 0 ? (1 / o.radius) * (point - o.centre) : vec{0, 1, 0};
  r.hits[i] = {point, normal, &o};
  r.materials[i] = o.made_of;
}

// Continues path i. Russian roulette may end it if it is dark; survivors get a larger weight.
void scatter(renderer& r, std::uint32_t i, vec direction, vec weight) {
  vec const t = r.throughput[i] * weight;
  float const survival = std::min(1.0F, std::max({t.x, t.y, t.z}));
  r.alive[i] = uniform(r.rng[i]) < survival;
  if (!r.alive[i]) return;
  r.throughput[i] = (1 / survival) * t;
  float const off = dot(direction, r.hits[i].normal) > 0 ? 1e-3F : -1e-3F;
  r.rays[i] = {r.hits[i].point + off * r.hits[i].normal, direction};
}

// A direction with cosine density: a point of the unit disk, lifted to the hemisphere.
void scatter_diffusely(renderer& r, std::uint32_t i, vec albedo) {
  float x = 0, y = 0, square = 1;
  while (square >= 1) {
    x = 2 * uniform(r.rng[i]) - 1;
    y = 2 * uniform(r.rng[i]) - 1;
    square = x * x + y * y;
  }
  vec const n = r.hits[i].normal;
  vec const u = unit(cross(n, std::abs(n.x) < 0.5F ? vec{1, 0, 0} : vec{0, 1, 0}));
  scatter(r, i, unit(x * u + y * cross(n, u) + std::sqrt(1 - square) * n), albedo);
}

void shade_matte(renderer& r, std::uint32_t i) {
  scatter_diffusely(r, i, r.hits[i].surface->colour);
}

void shade_checker(renderer& r, std::uint32_t i) {
  hit const& h = r.hits[i];
  float const half = 0.5F * (std::floor(h.point.x) + std::floor(h.point.z));
  scatter_diffusely(r, i, half == std::floor(half) ? h.surface->colour : h.surface->dark);
}

void shade_mirror(renderer& r, std::uint32_t i) {
  hit const& h = r.hits[i];
  scatter(r, i, reflected(r.rays[i].direction, h.normal), h.surface->colour);
}

// Reflects or refracts, with the probability of Fresnel's equations for unpolarised light.
void shade_glass(renderer& r, std::uint32_t i) {
  hit const& h = r.hits[i];
  vec const d = r.rays[i].direction;
  bool const enters = dot(d, h.normal) < 0;
  vec const n = enters ? h.normal : -1 * h.normal;
  float const eta = enters ? 1 / 1.5F : 1.5F;
  float const cos_in = -dot(d, n);
  float const cos_out = std::sqrt(std::max(0.0F, 1 - eta * eta * (1 - cos_in * cos_in)));
  float const s = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  float const p = (eta * cos_out - cos_in) / (eta * cos_out + cos_in);
  bool const reflects = cos_out == 0 || uniform(r.rng[i]) < 0.5F * (s * s + p * p);
  vec const refracted = unit(eta * d + (eta * cos_in - cos_out) * n);
  scatter(r, i, reflects ? reflected(d, n) : refracted, h.surface->colour);
}

void shade_lamp(renderer& r, std::uint32_t i) {
  r.radiance[i] = r.radiance[i] + r.throughput[i] * r.hits[i].surface->colour;
  r.alive[i] = 0;
}

void shade(renderer& r) {
  ds::shader_table const shaders{
      [&r](ds::request_index i) { shade_matte(r, i); },
      [&r](ds::request_index i) { shade_checker(r, i); },
      [&r](ds::request_index i) { shade_mirror(r, i); },
      [&r](ds::request_index i) { shade_glass(r, i); },
      [&r](ds::request_index i) { shade_lamp(r, i); },
  };  // in the order of enum material
  ds::shade(thrust::device, ds::local_sort_then_dispatch<>{}, size, r.materials.data(), shaders,
            r.scratch);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s PICTURE.pfm [SEED [furnace]]\n", argv[0]);
    return 2;
  }
  auto const seed = static_cast<std::uint32_t>(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
  renderer r;
  if (argc > 3 && std::string(argv[3]) == "furnace") r.world.make_furnace();
  std::uint32_t steps = 0;
  for (std::uint32_t sample = 0; sample < samples; ++sample) {
    for_each_path([&](std::uint32_t i) { start(r, i, sample, seed); });
    for (std::uint32_t step = 0; step < longest && any_alive(r); ++step, ++steps) {
      for_each_path([&r](std::uint32_t i) { intersect(r, i); });
      shade(r);
    }
  }
  for (vec& pixel : r.radiance) pixel = (1.0F / samples) * pixel;
  std::printf("%u samples a pixel, %u steps\n", samples, steps);
  if (write_picture(argv[1], width, r.radiance)) return 0;
  std::fprintf(stderr, "%s: cannot write %s\n", argv[0], argv[1]);
  return 1;
}
