// SPDX-License-Identifier: Apache-2.0
// Pictures of scenes that are very large or small, or far from the origin.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "hard_support.hpp"
#include "io/gltf.hpp"
#include "machines.hpp"

using namespace path_tracer;

namespace {

constexpr std::uint32_t side = 64, block = 8, blocks = side / block * (side / block);

/// The mean radiance of each block of a picture, for some seeds.
std::vector<std::vector<double>> block_means(scene const& s, std::string const& machine,
                                             std::uint64_t first_seed, int seeds) {
  std::vector<std::vector<double>> means;
  for (int k = 0; k < seeds; ++k) {
    render_settings settings = small(16, 8, machine);
    settings.width = settings.height = side;
    settings.seed = first_seed + static_cast<std::uint64_t>(k);
    render_result const r = render(s, settings);
    REQUIRE(r.discarded_samples == 0);
    means.emplace_back(blocks);
    for (std::uint32_t i = 0; i < side * side; ++i)
      means.back()[i / side / block * (side / block) + i % side / block] +=
          double{luminance(r.pixels[i])} / (block * block);
  }
  return means;
}

struct difference {
  double mean_z2;   ///< over blocks: squared difference over its variance; 1 for equal pictures
  double relative;  ///< median over blocks: difference over the mean of the first
};

difference between(std::vector<std::vector<double>> const& a,
                   std::vector<std::vector<double>> const& b) {
  auto const n = static_cast<double>(a.size());
  double z2 = 0;
  std::vector<double> relative;
  for (std::size_t k = 0; k < blocks; ++k) {
    auto const moments = [&](std::vector<std::vector<double>> const& of) {
      double sum = 0, sum2 = 0;
      for (auto const& picture : of) sum += picture[k];
      for (auto const& picture : of) sum2 += (picture[k] - sum / n) * (picture[k] - sum / n);
      return glm::dvec2{sum / n, sum2 / (n - 1) / n};
    };
    glm::dvec2 const p = moments(a), q = moments(b);
    double const d = p.x - q.x;
    z2 += p.y + q.y > 0 ? d * d / (p.y + q.y) : 0;
    relative.push_back(std::abs(d) / p.x);
  }
  std::nth_element(relative.begin(), relative.begin() + blocks / 2, relative.end());
  return {z2 / blocks, relative[blocks / 2]};
}

}  // namespace

TEST_CASE("a room far from the origin looks like the same room at it", "[hard]") {
  std::filesystem::path const path =
      std::filesystem::path(DEFERRED_SHADE_SHARED_SCENES) / "cornell.glb";
  if (!std::filesystem::exists(path)) {
    WARN("skipped: there is no " << path.string());
    return;
  }
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene const s = load_gltf(path.string());
  auto const here = block_means(s, machine, 1, 8);
  // Of 64 blocks and 14 degrees of freedom the mean is 1.17, its deviation 0.27.
  difference const again = between(here, block_means(s, machine, 101, 8));
  difference const there =
      between(here, block_means(moved_by(s, {2000, -1000, 500}), machine, 201, 8));
  CAPTURE(again.mean_z2, there.mean_z2, again.relative, there.relative);
  CHECK(again.mean_z2 < 2.2);
  CHECK(there.mean_z2 < 2.2);
  // So far away a coordinate has steps of 1/128, and the room is 2 wide.
  difference const far = between(here, block_means(moved_by(s, {1e5, -1e5, 1e5}), machine, 301, 8));
  CAPTURE(far.mean_z2, far.relative);
  CHECK(far.relative < 0.1);
}
