// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders.hpp"

namespace path_tracer {

/// The shader of a point inside the medium: one light sample, one direction by the phase function.
template <class Set>
struct surface_shader<effects::medium, Set> {
  wave_view<Set> wave;
  scene_view scene;

  PT_HD void operator()(deferred_shade::request_index i) const {
    vec3 const throughput = wave.throughput[i];
    wave.throughput[i] = vec3{0};
    if (wave.bounce + 1 >= wave.max_depth) return;
    if constexpr (has_lights<Set>) add_light(i, throughput);
    real survival = 1;
    random_stream const random = wave.random(i);
    if (wave.bounce + 1 >= wave.roulette_from) {
      survival = glm::min(real(0.95), max_component(throughput));
      if (random.pair(pair_of(draw::lobe_and_roulette, wave.bounce)).y >= survival) return;
    }
    vec2 const u = random.pair(pair_of(draw::direction, wave.bounce));
    real const cosine = sample_phase(scene.medium.anisotropy, u.x);
    surface frame;
    set_frame(frame, wave.direction[i], vec3{0});
    wave.pdf[i] = phase(scene.medium.anisotropy, cosine);
    wave.direction[i] = glm::normalize(frame.to_world(polar(cosine, 2 * pi * u.y)));
    wave.throughput[i] = throughput / survival;
  }

 private:
  PT_HD void add_light(std::uint32_t i, vec3 throughput) const {
    if (scene.lights.count == 0) return;
    vec3 const p = wave.origin[i];
    light_sample const l = sample_light<Set>(scene.lights, p, draws_of_light<Set>(wave, i));
    if (!(l.pdf > 0)) return;
    real const density = phase(scene.medium.anisotropy, glm::dot(l.wi, vec3(wave.direction[i])));
    real const weight = l.delta ? real(1) : weight_of_light(scene.lights.how, l.pdf, density);
    wave.shadow_origin[i] = p;
    wave.shadow_vector[i] = l.wi * l.distance + l.clearance;
    wave.shadow_light[i] = throughput * density * arriving<Set>(scene, l) * (weight / l.pdf);
  }
};

}  // namespace path_tracer
