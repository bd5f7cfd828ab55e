// SPDX-License-Identifier: Apache-2.0
// A path tracer in one file: 06_path_tracer [PICTURE.png [SCHEDULE]].
//
// The renderer is a wavefront. A batch holds one path for each pixel, in arrays. At every bounce,
// one stage finds what each ray hits. Then ds::shade runs the shader of the material that was hit.
// The program renders twice, by SCHEDULE and by a plain switch. It fails if the pictures differ.
// THRUST_DEVICE_SYSTEM says where it runs: on one thread (CPP), on all (OMP, TBB) or on a GPU
// (CUDA).
#include <thrust/device_vector.h>
#include <thrust/execution_policy.h>
#include <thrust/for_each.h>
#include <thrust/host_vector.h>
#include <thrust/iterator/counting_iterator.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <deferred_shade/deferred_shade.hpp>
#include <string>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

#define HD DEFERRED_SHADE_HOST_DEVICE
namespace ds = deferred_shade;

namespace {

constexpr std::uint32_t width = 640, height = 360, pixels = width * height;
constexpr std::uint32_t samples = 24, bounces = 10;

// A point, a direction or a colour.
struct vec {
  float x, y, z;
};
HD vec operator+(vec a, vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HD vec operator-(vec a, vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HD vec operator*(vec a, vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
HD vec operator*(float s, vec a) { return {s * a.x, s * a.y, s * a.z}; }
HD float dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HD vec unit(vec a) { return (1 / std::sqrt(dot(a, a))) * a; }
HD vec mix(vec a, vec b, float share) { return (1 - share) * a + share * b; }
HD vec reflect(vec d, vec normal) { return d - 2 * dot(d, normal) * normal; }

// Random numbers in [0, 1): SplitMix64 (Steele, Lea and Flood 2014). The pixel, its sample and the
// bounce choose the sequence. So a shader draws the same numbers whenever and wherever it runs.
struct random_numbers {
  std::uint64_t state;
  HD random_numbers(std::uint32_t pixel, std::uint32_t sample, std::uint32_t bounce)
      : state((std::uint64_t{sample} << 48) + (std::uint64_t{bounce} << 32) + pixel) {}

  HD float next() {
    state += 0x9e3779b97f4a7c15U;
    std::uint64_t z = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24F;
  }

  HD vec in_ball() {
    for (;;) {
      vec const v{2 * next() - 1, 2 * next() - 1, 2 * next() - 1};
      float const square = dot(v, v);
      if (square < 1 && square > 0) return v;
    }
  }
};

// The positions of the shaders in the table. What lies outside the table runs no shader.
enum class material : std::uint8_t { sky, matte, metal, glass, light, ended = 255 };

struct sphere {
  vec center;
  float radius;
  material made_of;
  vec color;  // what is reflected or let through; a light's radiance
};

struct scene {
  static constexpr int size = 36;
  sphere spheres[size];
};

struct ray {
  vec origin, direction;
};

struct hit {
  vec point, normal;  // the normal points out of the sphere
  vec color;
};

// A view of the batch: arrays with an entry for each path. Path i belongs to pixel i.
struct wavefront {
  ray* rays;
  hit* hits;
  material* materials;  // of the hits: the ids of the shaders to run
  vec* throughput;      // the share of light that the path carries to the camera; black: it ended
  vec* radiance;        // of the pixel: the sum of its samples
  std::uint32_t sample = 0, bounce = 0;

  HD random_numbers random(ds::request_index i) const { return {i, sample, bounce}; }

  HD void scatter(ds::request_index i, vec direction, vec weight) const {
    hit const& h = hits[i];
    float const off = dot(direction, h.normal) > 0 ? 1e-3F : -1e-3F;  // do not hit it again
    rays[i] = {h.point + off * h.normal, direction};
    throughput[i] = throughput[i] * weight;
  }

  HD void end(ds::request_index i, vec emitted) const {
    radiance[i] = radiance[i] + throughput[i] * emitted;
    throughput[i] = {0, 0, 0};
  }
};

// ---- Two stages of the loop. They are the same work for every path, so nothing needs regrouping.

struct start_path {
  wavefront w;
  HD void operator()(ds::request_index i) const {
    random_numbers random = w.random(i);
    float const x = static_cast<float>(i % width) + random.next() - 0.5F * width;
    float const y = static_cast<float>(i / width) + random.next() - 0.13F * height;
    w.rays[i] = {{0, 3.4F, 10.5F}, unit({x, -y, -1.6F * height})};
    w.throughput[i] = {1, 1, 1};
  }
};

// How far along a ray a sphere is hit; infinity if it is not.
HD float distance(sphere const& s, ray const& r) {
  vec const to_center = s.center - r.origin;
  float const middle = dot(to_center, r.direction);
  vec const beside = to_center - middle * r.direction;
  float const square = s.radius * s.radius - dot(beside, beside);
  float const half = std::sqrt(square < 0 ? 0 : square);
  float const t = middle > half ? middle - half : middle + half;
  return square < 0 || t <= 0 ? INFINITY : t;
}

struct find_hit {
  wavefront w;
  scene world;
  HD void operator()(ds::request_index i) const {
    vec const carried = w.throughput[i];
    w.materials[i] = material::ended;
    if (carried.x + carried.y + carried.z <= 0) return;
    ray const r = w.rays[i];
    sphere const* nearest = nullptr;
    float t = INFINITY;
    for (sphere const& s : world.spheres) {
      float const d = distance(s, r);
      if (d < t) nearest = &s;
      if (d < t) t = d;
    }
    w.materials[i] = nearest != nullptr ? nearest->made_of : material::sky;
    if (nearest == nullptr) return;
    vec const point = r.origin + t * r.direction;
    w.hits[i] = {point, (1 / nearest->radius) * (point - nearest->center), nearest->color};
  }
};

// ---- The shaders, one for each material.

struct sky {
  wavefront w;
  HD void operator()(ds::request_index i) const {
    float const up = w.rays[i].direction.y + 0.1F;
    vec const horizon{1.0F, 0.8F, 0.6F}, zenith{0.2F, 0.4F, 0.85F};
    w.end(i, mix(horizon, zenith, std::sqrt(up > 0 ? up : 0)));
  }
};

struct matte {
  wavefront w;
  HD void operator()(ds::request_index i) const {
    hit const h = w.hits[i];
    vec const on_sphere = unit(w.random(i).in_ball());
    w.scatter(i, unit(h.normal + 0.999F * on_sphere), h.color);  // its density: the cosine
  }
};

struct metal {
  wavefront w;
  HD void operator()(ds::request_index i) const {
    hit const h = w.hits[i];
    vec const mirrored = reflect(w.rays[i].direction, h.normal);
    vec const direction = unit(mirrored + 0.1F * w.random(i).in_ball());  // brushed a little
    if (dot(direction, h.normal) <= 0) return w.end(i, {0, 0, 0});
    w.scatter(i, direction, h.color);
  }
};

// Reflects or refracts, with the probability that Schlick's approximation (1994) gives.
struct glass {
  wavefront w;
  HD void operator()(ds::request_index i) const {
    hit const h = w.hits[i];
    vec const d = w.rays[i].direction;
    bool const enters = dot(d, h.normal) < 0;
    vec const n = enters ? h.normal : -1 * h.normal;
    float const eta = enters ? 1 / 1.5F : 1.5F;
    float const cos_in = -dot(d, n);
    float const square = 1 - eta * eta * (1 - cos_in * cos_in);  // of the other cosine
    float const cos_out = std::sqrt(square < 0 ? 0 : square);
    float const rest = 1 - (enters ? cos_in : cos_out);
    float const reflectance = 0.04F + 0.96F * rest * rest * rest * rest * rest;
    bool const reflects = square < 0 || w.random(i).next() < reflectance;
    vec const refracted = eta * d + (eta * cos_in - cos_out) * n;
    w.scatter(i, unit(reflects ? reflect(d, n) : refracted), h.color);
  }
};

struct light {
  wavefront w;
  HD void operator()(ds::request_index i) const { w.end(i, w.hits[i].color); }
};

// ---- The loop.

template <class Schedule>
thrust::host_vector<vec> render(Schedule const& schedule, scene const& world) {
  thrust::device_vector<ray> rays(pixels);
  thrust::device_vector<hit> hits(pixels);
  thrust::device_vector<material> materials(pixels);
  thrust::device_vector<vec> throughput(pixels), radiance(pixels, vec{0, 0, 0});
  wavefront w{rays.data().get(), hits.data().get(), materials.data().get(), throughput.data().get(),
              radiance.data().get()};
  ds::workspace scratch{thrust::device};
  thrust::counting_iterator<ds::request_index> const first(0);

  for (w.sample = 0; w.sample < samples; ++w.sample) {
    w.bounce = 0;  // the random numbers of the camera's rays
    thrust::for_each_n(thrust::device, first, pixels, start_path{w});
    for (w.bounce = 1; w.bounce <= bounces; ++w.bounce) {
      thrust::for_each_n(thrust::device, first, pixels, find_hit{w, world});
      ds::shader_table const shaders{sky{w}, matte{w}, metal{w}, glass{w}, light{w}};
      ds::shade(thrust::device, schedule, pixels, w.materials, shaders, scratch);
    }
  }
  return radiance;
}

// ---- The scene: a large ball as the ground, and a sunflower's spiral of small ones on it.

vec color_of(material kind, float number) {
  vec const hue{std::cos(1.7F * number), std::cos(1.7F * number + 2), std::cos(1.7F * number + 4)};
  vec const color = vec{0.5F, 0.5F, 0.5F} + 0.4F * hue;
  if (kind == material::light) return {4, 1.6F, 0.5F};
  float const strength = kind == material::glass ? 0.1F : kind == material::metal ? 0.4F : 1;
  return mix({1, 1, 1}, color, strength);
}

scene make_scene() {
  constexpr material kinds[] = {material::matte, material::glass, material::metal, material::matte,
                                material::metal, material::glass, material::light};
  scene s{};
  s.spheres[0] = {{0, -500, 0}, 500, material::matte, {0.7F, 0.6F, 0.5F}};
  for (int k = 1; k < scene::size; ++k) {
    auto const number = static_cast<float>(k);
    float const angle = 2.3999632F * number, distance = 0.78F * std::sqrt(number - 0.5F);
    float const radius = 0.35F + 0.04F * distance;
    vec const center{distance * std::cos(angle), radius, distance * std::sin(angle)};
    s.spheres[k] = {center, radius, kinds[k % 7], color_of(kinds[k % 7], number)};
  }
  return s;
}

thrust::host_vector<vec> render_by(std::string const& schedule) {
  scene const world = make_scene();
  if (schedule == "switch") return render(ds::implicit_serialization{}, world);
  if (schedule == "bucket") return render(ds::bucket_then_dispatch<>{}, world);
  if (schedule == "local") return render(ds::local_sort_then_dispatch<>{}, world);
  if (schedule == "window") return render(ds::window_sort_then_dispatch{}, world);
  return {};
}

bool write_png(char const* name, thrust::host_vector<vec> const& radiance) {
  std::vector<unsigned char> bytes;
  for (vec const& sum : radiance) {
    for (float const channel : {sum.x, sum.y, sum.z}) {
      float const display = std::sqrt(std::min(channel / samples, 1.0F));  // nearly sRGB
      bytes.push_back(static_cast<unsigned char>(255 * display + 0.5F));
    }
  }
  return stbi_write_png(name, width, height, 3, bytes.data(), 3 * width) != 0;
}

float mean_of(thrust::host_vector<vec> const& radiance) {
  double sum = 0;
  for (vec const& r : radiance) sum += r.x + r.y + r.z;
  return static_cast<float>(sum / (3.0 * pixels * samples));
}

int fail(char const* why) {
  std::fprintf(stderr, "06_path_tracer: %s\n", why);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  char const* const file = argc > 1 ? argv[1] : "06_path_tracer.png";
  std::string const schedule = argc > 2 ? argv[2] : "bucket";

  auto const start = std::chrono::steady_clock::now();
  thrust::host_vector<vec> const radiance = render_by(schedule);
  std::chrono::duration<double> const time = std::chrono::steady_clock::now() - start;
  if (radiance.empty()) return fail("the schedules are switch, bucket, local and window");
  if (!write_png(file, radiance)) return fail("the picture cannot be written");
  float const mean = mean_of(radiance);
  std::printf("%s: %.2f s, mean radiance %.4f\n", file, time.count(), mean);

  thrust::host_vector<vec> const expected = render_by("switch");
  bool const same = std::memcmp(radiance.data(), expected.data(), pixels * sizeof(vec)) == 0;
  if (!same) return fail("the switch renders another picture");
  return std::isfinite(mean) && mean > 0 ? 0 : fail("the picture has no light");
}
