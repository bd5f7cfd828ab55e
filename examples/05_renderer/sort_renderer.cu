// SPDX-License-Identifier: Apache-2.0
// A small wavefront path tracer for a GPU: RENDERER PICTURE.pfm [SEED [balls|furnace [SCALE]]]. The
// picture has SCALE times as many rows and columns as without. The batch holds a path for each
// pixel, in an array of structs; a step intersects all paths that go on, then shades each by the
// material that it hit.
#include <thrust/copy.h>
#include <thrust/device_vector.h>
#include <thrust/execution_policy.h>
#include <thrust/partition.h>
#include <thrust/sort.h>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "picture.hpp"
#include "scene.hpp"
#include "vec.hpp"

namespace {

constexpr std::uint32_t samples = 8;
constexpr std::uint32_t longest = 64;  // path, in steps

struct path {
  std::uint64_t rng;
  ray along;
  vec throughput;
  vec point, normal;      // of the hit; the normal points out of the object
  std::uint32_t surface;  // the object that was hit
  std::uint32_t pixel;
  bool alive;
};
static_assert(sizeof(path) == 80);

// Knuth's linear congruential generator for MMIX: a number in [0, 1) from its highest bits.
HD float uniform(std::uint64_t& state) {
  state = 6364136223846793005U * state + 1442695040888963407U;
  return static_cast<float>(state >> 40) * 0x1p-24F;
}

// Continues a path. Russian roulette may end it if it is dark; survivors get a larger weight.
HD void scatter(path& p, vec direction, vec weight) {
  vec const t = p.throughput * weight;
  float const brightest = std::fmax(std::fmax(t.x, t.y), t.z);
  float const survival = std::fmin(1.0F, brightest);
  p.alive = uniform(p.rng) < survival;
  if (!p.alive) return;
  p.throughput = (1 / survival) * t;
  float const off = dot(direction, p.normal) > 0 ? 1e-3F : -1e-3F;
  p.along = {p.point + off * p.normal, direction};
}

// A direction with cosine density: a point of the unit disk, lifted to the hemisphere.
HD void scatter_diffusely(path& p, vec albedo) {
  float x = 0, y = 0, square = 1;
  while (square >= 1) {
    x = 2 * uniform(p.rng) - 1;
    y = 2 * uniform(p.rng) - 1;
    square = x * x + y * y;
  }
  vec const n = p.normal;
  vec const u = unit(cross(n, std::abs(n.x) < 0.5F ? vec{1, 0, 0} : vec{0, 1, 0}));
  scatter(p, unit(x * u + y * cross(n, u) + std::sqrt(1 - square) * n), albedo);
}

HD void shade_checker(path& p, object const& o) {
  float const half = 0.5F * (std::floor(p.point.x) + std::floor(p.point.z));
  scatter_diffusely(p, half == std::floor(half) ? o.colour : o.dark);
}

// Reflects or refracts, with the probability of Fresnel's equations for unpolarised light.
HD void shade_glass(path& p, object const& o) {
  vec const d = p.along.direction;
  bool const enters = dot(d, p.normal) < 0;
  vec const n = enters ? p.normal : -1 * p.normal;
  float const eta = enters ? 1 / 1.5F : 1.5F;
  float const cos_in = -dot(d, n);
  float const cos_out = std::sqrt(std::fmax(0.0F, 1 - eta * eta * (1 - cos_in * cos_in)));
  float const s = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  float const q = (eta * cos_out - cos_in) / (eta * cos_out + cos_in);
  bool const reflects = cos_out == 0 || uniform(p.rng) < 0.5F * (s * s + q * q);
  vec const refracted = unit(eta * d + (eta * cos_in - cos_out) * n);
  scatter(p, reflects ? reflected(d, n) : refracted, o.colour);
}

HD void shade_lamp(path& p, object const& o, vec* film) {
  film[p.pixel] = film[p.pixel] + p.throughput * o.colour;
  p.alive = false;
}

HD void shade_hit(path& p, object const& o, vec* film) {
  switch (o.made_of) {
    case matte:
      return scatter_diffusely(p, o.colour);
    case checker:
      return shade_checker(p, o);
    case mirror:
      return scatter(p, reflected(p.along.direction, p.normal), o.colour);
    case glass:
      return shade_glass(p, o);
    case lamp:
      return shade_lamp(p, o, film);
  }
}

constexpr unsigned threads = 256;
unsigned blocks(std::uint32_t n) { return (n + threads - 1) / threads; }
__device__ std::uint32_t index() { return blockIdx.x * threads + threadIdx.x; }

__global__ void start(std::uint32_t size, std::uint32_t width, path* paths, std::uint32_t sample,
                      std::uint32_t seed) {
  std::uint32_t const i = index();
  if (i >= size) return;
  path& p = paths[i];
  std::uint64_t& rng = p.rng = (std::uint64_t{seed} << 32) + sample * size + i;
  for (int k = 0; k < 3; ++k) rng = (rng ^ (rng >> 32)) * 0x9e3779b97f4a7c15U;  // far apart
  auto const columns = static_cast<float>(width), rows = static_cast<float>(size / width);
  float const x = static_cast<float>(i % width) + uniform(rng) - 0.5F * columns;
  float const y = static_cast<float>(i / width) + uniform(rng) - 0.5F * rows;
  p.along = {{0, 2, 8}, unit({x, y, -1.2F * rows})};
  p.throughput = {1, 1, 1};
  p.pixel = i;
  p.alive = true;
}

__global__ void intersect(std::uint32_t n, path* paths, std::uint8_t* ids, scene world) {
  std::uint32_t const i = index();
  if (i >= n) return;
  path& p = paths[i];
  float t = 0;
  object const& o = world.first_hit(p.along, t);
  p.point = p.along.origin + t * p.along.direction;
  p.normal = o.radius > 0 ? (1 / o.radius) * (p.point - o.centre) : vec{0, 1, 0};
  p.surface = static_cast<std::uint32_t>(&o - world.objects);
  ids[i] = o.made_of;
}

__global__ void shade(std::uint32_t n, path* paths, scene world, vec* film) {
  std::uint32_t const i = index();
  if (i >= n) return;
  path p = paths[i];
  shade_hit(p, world.objects[p.surface], film);
  paths[i] = p;
}

template <class T>
T* raw(thrust::device_vector<T>& v) {
  return v.data().get();
}

struct renderer {
  std::uint32_t size, width;
  scene world{};
  thrust::device_vector<vec> film = thrust::device_vector<vec>(size);  // summed over samples
  thrust::device_vector<path> paths = thrust::device_vector<path>(size);
  thrust::device_vector<std::uint8_t> ids = thrust::device_vector<std::uint8_t>(size);  // materials
};

void trace_frame(renderer& r, std::uint32_t sample, std::uint32_t seed) {
  auto const exec = thrust::cuda::par_nosync;
  std::uint32_t n = r.size;
  start<<<blocks(r.size), threads>>>(r.size, r.width, raw(r.paths), sample, seed);
  auto const goes_on = [] __device__(path const& p) { return p.alive; };
  for (std::uint32_t step = 0; step < longest && n > 0; ++step) {
    intersect<<<blocks(n), threads>>>(n, raw(r.paths), raw(r.ids), r.world);
    thrust::sort_by_key(exec, r.ids.begin(), r.ids.begin() + n, r.paths.begin());
    shade<<<blocks(n), threads>>>(n, raw(r.paths), r.world, raw(r.film));
    auto const end = thrust::partition(exec, r.paths.begin(), r.paths.begin() + n, goes_on);
    n = static_cast<std::uint32_t>(end - r.paths.begin());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s PICTURE.pfm [SEED [balls|furnace [SCALE]]]\n", argv[0]);
    return 2;
  }
  auto const number = [&](int k) {
    return argc > k ? static_cast<std::uint32_t>(std::strtoul(argv[k], nullptr, 10)) : 1;
  };
  std::uint32_t const width = 320 * number(4), height = 240 * number(4);
  renderer r{width * height, width};
  if (argc > 3 && std::string(argv[3]) == "furnace") r.world.make_furnace();
  cudaEvent_t begin{}, end{};
  cudaEventCreate(&begin);
  cudaEventCreate(&end);
  for (std::uint32_t sample = 0; sample < samples; ++sample) {
    if (sample == 1) cudaEventRecord(begin);  // the first frame allocates
    trace_frame(r, sample, number(2));
  }
  cudaEventRecord(end);
  cudaEventSynchronize(end);
  float milliseconds = 0;
  cudaEventElapsedTime(&milliseconds, begin, end);
  cudaError_t const status = cudaGetLastError();  // of all calls and kernels
  if (status != cudaSuccess) {
    std::fprintf(stderr, "%s: %s\n", argv[0], cudaGetErrorString(status));
    return 1;
  }
  std::vector<vec> pixels(r.size);
  thrust::copy(r.film.begin(), r.film.end(), pixels.begin());
  for (vec& pixel : pixels) pixel = (1.0F / samples) * pixel;
  std::printf("%u samples a pixel, %.3f ms a frame\n", samples, milliseconds / (samples - 1));
  if (write_picture(argv[1], width, pixels)) return 0;
  std::fprintf(stderr, "%s: cannot write %s\n", argv[0], argv[1]);
  return 1;
}
