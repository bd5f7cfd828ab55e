// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/shaders.hpp"

namespace path_tracer {

/// The shader of a point inside the medium: one light sample, one direction by the phase function.
template <class Set>
struct surface_shader<effects::medium, Set> {
  batch_view<Set> batch;
  scene_view scene;

  PT_HD void operator()(deferred_shade::request_index i) const {
    vec3 const throughput = batch.throughput[i];
    batch.throughput[i] = vec3{0};
    if (batch.bounce + 1 >= batch.max_depth) return;
    if constexpr (has_lights<Set>) add_light(i, throughput);
    real survival = 1;
    random_stream const random = batch.random(i);
    if (batch.bounce + 1 >= batch.roulette_from) {
      survival = survival_of(throughput);
      if (random.pair(pair_of(draw::lobe_and_roulette, batch.bounce)).y >= survival) return;
    }
    vec2 const u = random.pair(pair_of(draw::direction, batch.bounce));
    real const cosine = sample_phase(scene.medium.anisotropy, u.x);
    surface frame;
    set_frame(frame, batch.direction[i], vec3{0});
    batch.pdf[i] = phase(scene.medium.anisotropy, cosine);
    batch.direction[i] = glm::normalize(frame.to_world(polar(cosine, 2 * pi * u.y)));
    batch.throughput[i] = throughput / survival;
    if constexpr (path_array<effects::smooth_glass, Set>::exists)
      batch.template state<effects::smooth_glass>(i) = 0;
  }

 private:
  PT_HD void add_light(std::uint32_t i, vec3 throughput) const {
    if (scene.lights.count == 0) return;
    vec3 const p = batch.origin[i];
    light_sample const l = sample_light<Set>(scene.lights, p, draws_of_light<Set>(batch, i));
    if (!(l.pdf > 0)) return;
    real const density = phase(scene.medium.anisotropy, glm::dot(l.wi, vec3(batch.direction[i])));
    real const weight = l.delta ? real(1) : weight_of_light(scene.lights.how, l.pdf, density);
    batch.shadow_origin[i] = p;
    batch.shadow_vector[i] = l.wi * l.distance + l.clearance;
    batch.shadow_light[i] = throughput * density * arriving<Set>(scene, l) * (weight / l.pdf);
  }
};

}  // namespace path_tracer
