// SPDX-License-Identifier: Apache-2.0
// A loop that is no renderer. Particles fly through a rod of three layers, each of another
// material, in which they are absorbed or turned around. ds::run keeps the slots busy until all
// have ended.
//
// A rod has a closed form. In a layer of length L with absorption a and scattering s, with
// k = sqrt(a (a + s)), the shares that pass and that return are
//     T = 1 / (cosh kL + (a + s/2) / k sinh kL),   R = s / (2k) sinh kL T
// (Schuster 1905). The program runs by every loop, and fails if the particles miss that.
#include <thrust/execution_policy.h>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

#include "slots_at_once.hpp"

namespace ds = deferred_shade;
namespace {

constexpr std::uint64_t particles = 1'000'000, slots = 1 << 16;

struct layer {
  double length, absorption, scattering;
};
constexpr int layer_count = 3;
constexpr layer layers[layer_count] = {{0.5, 0.0, 1.5}, {0.3, 0.8, 0.0}, {1.2, 0.2, 1.1}};

enum class outcome : std::uint8_t { none, returned, absorbed, passed };
// The positions of the stages in the table. `ended` lies outside.
enum class stage : std::uint8_t { fly, scatter, absorb, either, ended };
constexpr stage collisions[layer_count] = {stage::scatter, stage::absorb, stage::either};

struct particle {
  std::uint64_t item;
  std::uint32_t draws;  // random numbers that it has used
  int layer, direction;
  double place;  // in its layer, from the left
  // SplitMix64 (Steele, Lea and Flood 2014), keyed by the particle: who runs it does not matter.
  double random() {
    std::uint64_t z = (item << 16) + 0x9e3779b97f4a7c15U * ++draws;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
  }
};

struct state {
  particle* slot;
  outcome* outcomes;  // by particle
  stage end(ds::request_index i, outcome what) const {
    outcomes[slot[i].item] = what;
    return stage::ended;
  }
};
struct begin {
  state s;
  stage operator()(ds::request_index i, ds::item_index k) const {
    s.slot[i] = {k, 0, 0, 1, 0.0};
    return stage::fly;
  }
};
struct fly {
  state s;
  stage operator()(ds::request_index i) const {
    particle& p = s.slot[i];
    layer const& here = layers[p.layer];
    double const left = p.direction > 0 ? here.length - p.place : p.place;  // to the layer's end
    double const flight = -std::log(p.random()) / (here.absorption + here.scattering);
    if (flight < left) {
      p.place += p.direction * flight;
      return collisions[p.layer];
    }
    p.layer += p.direction;
    if (p.layer < 0) return s.end(i, outcome::returned);
    if (p.layer == layer_count) return s.end(i, outcome::passed);
    p.place = p.direction > 0 ? 0.0 : layers[p.layer].length;
    return stage::fly;
  }
};
struct scatter {
  state s;
  stage operator()(ds::request_index i) const {
    particle& p = s.slot[i];
    p.direction = p.random() < 0.5 ? -1 : 1;
    return stage::fly;
  }
};
struct absorb {
  state s;
  stage operator()(ds::request_index i) const { return s.end(i, outcome::absorbed); }
};
struct either {
  state s;
  stage operator()(ds::request_index i) const {
    particle& p = s.slot[i];
    layer const& here = layers[p.layer];
    bool const ends = p.random() * (here.absorption + here.scattering) < here.absorption;
    return ends ? stage::absorb : stage::scatter;
  }
};

// The shares that pass and that return, by the closed form.
struct shares {
  double passed = 1, returned = 0;
};
shares expected() {
  shares all;
  double from_right = 0;  // what the layers so far return to the right
  for (layer const& l : layers) {
    double const k = std::sqrt(l.absorption * (l.absorption + l.scattering));
    double const wave = k > 0 ? std::sinh(k * l.length) / k : l.length;
    double const t = 1 / (std::cosh(k * l.length) + (l.absorption + l.scattering / 2) * wave);
    double const r = l.scattering / 2 * wave * t;
    double const between = 1 / (1 - from_right * r);
    all.returned += all.passed * all.passed * r * between;
    from_right = r + t * t * from_right * between;
    all.passed *= t * between;
  }
  return all;
}

}  // namespace
int main() {
  std::vector<particle> slot(slots);
  bool good = true;
  auto const go = [&](char const* name, auto const& loop) {
    std::vector<outcome> outcomes(particles);
    state const s{slot.data(), outcomes.data()};
    ds::shader_table const stages{fly{s}, scatter{s}, absorb{s}, either{s}};
    ds::workspace scratch{thrust::device};
    ds::run(thrust::device, loop, ds::items{particles, slots}, begin{s}, stages, scratch);
    double count[4] = {};
    for (outcome const o : outcomes) ++count[static_cast<int>(o)];
    auto const check = [&](char const* what, outcome o, double share) {
      double const found = count[static_cast<int>(o)] / particles;
      double const error = std::sqrt(share * (1 - share) / particles);
      good = good && std::abs(found - share) < 4 * error && count[0] == 0;
      std::printf("%s: %s %.4f, closed form %.4f +- %.4f\n", name, what, found, share, error);
    };
    check("passed", outcome::passed, expected().passed);
    check("returned", outcome::returned, expected().returned);
  };
  ds::for_each_loop(go);
  go("slots at once", slots_at_once<ds::local_sort_then_dispatch<>>{});
  return good ? 0 : 1;
}
