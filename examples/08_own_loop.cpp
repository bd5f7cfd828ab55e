// SPDX-License-Identifier: Apache-2.0
// Loops of a renderer's own on a CPU, one for each material. The number of materials is known at
// run time only. Each bounce gathers the paths that go on, in the order of their materials.
#include <thrust/execution_policy.h>
#include <thrust/for_each.h>
#include <thrust/iterator/transform_iterator.h>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

namespace ds = deferred_shade;

namespace {

constexpr int bounces = 6;

struct path {
  std::uint32_t pixel, random;
  float weight;
  std::int32_t material;  // that it hits next, or -1 if it has ended
};

void shade(float albedo, std::uint32_t materials, path& p) {
  p.weight *= albedo;
  p.random = p.random * 1664525U + 1013904223U;
  p.material = p.random >> 28 == 0 ? -1 : static_cast<std::int32_t>((p.random >> 8) % materials);
}

std::vector<float> render(std::vector<path> paths, std::vector<float> const& albedos) {
  auto const exec = thrust::device;
  auto const materials = static_cast<ds::shader_id>(albedos.size());
  std::vector<float> film(paths.size());
  std::vector<path> next(paths.size());
  ds::workspace scratch{exec};
  for (int b = 0; b < bounces; ++b) {
    auto const ids =
        thrust::make_transform_iterator(paths.data(), [](path const& p) { return p.material; });
    auto const groups = ds::group(exec, paths.size(), ids, materials, scratch);
    ds::gather(exec, groups.live(), ds::moved{paths.data(), next.data()});
    paths.swap(next);
    paths.resize(groups.offsets[materials]);  // those that have ended are gone
    for (ds::shader_id k = 0; k < materials; ++k) {
      thrust::for_each(exec, paths.data() + groups.offsets[k], paths.data() + groups.offsets[k + 1],
                       [out = film.data(), albedo = albedos[k], materials](path& p) {
                         shade(albedo, materials, p);
                         out[p.pixel] = p.weight;
                       });
    }
  }
  return film;
}

}  // namespace

int main() {
  std::vector<float> albedos;
  for (int k = 0; k < 40; ++k) albedos.push_back(1.0F - 0.01F * static_cast<float>(k));
  auto const materials = static_cast<std::uint32_t>(albedos.size());
  std::vector<path> paths;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    paths.push_back({i, i * 2654435761U, 1.0F, static_cast<std::int32_t>(i % materials)});
  }

  std::vector<float> expected;  // by a loop over one path at a time
  for (path p : paths) {
    for (int b = 0; b < bounces && p.material >= 0; ++b) {
      shade(albedos[static_cast<std::size_t>(p.material)], materials, p);
    }
    expected.push_back(p.weight);
  }
  bool const right = render(paths, albedos) == expected;
  std::printf("%zu paths, %u materials: %s\n", paths.size(), materials, right ? "right" : "wrong");
  return right ? 0 : 1;
}
