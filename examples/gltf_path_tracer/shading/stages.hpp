// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/types.hpp>

#include "scene/surface.hpp"
#include "shading/path.hpp"
#include "shading/shaders.hpp"
#include "shading/sums.hpp"

namespace path_tracer {

using deferred_shade::request_index;

/// Half the width and height of the view at distance 1 (or of an orthographic view). A file gives
/// the vertical field of view. The width follows from the shape of the picture, not from the aspect
/// ratio of the file.
PT_HD inline vec2 half_extent(camera const& view, real aspect) {
  real const y = view.ortho_height > 0 ? view.ortho_height : view.tan_half_yfov;
  return {y * aspect, y};
}

/// Starts the paths of a batch: camera rays through random points of their pixels.
template <class Set>
struct generate_paths {
  batch_view<Set> batch;
  camera view;
  std::uint32_t width, height;

  PT_HD void operator()(request_index i) const {
    std::uint32_t const pixel = batch.pixel(i);
    vec2 const jitter = batch.random(i).pair(0);
    auto const w = static_cast<real>(width), h = static_cast<real>(height);
    vec2 const half = half_extent(view, w / h);
    real const x = ((static_cast<real>(pixel % width) + jitter.x) * 2 / w - 1) * half.x;
    real const y = (1 - (static_cast<real>(pixel / width) + jitter.y) * 2 / h) * half.y;
    vec3 const aside = x * view.right + y * view.up;
    bool const parallel = view.ortho_height > 0;
    ray r{parallel ? view.position + aside : view.position,
          parallel ? view.forward : glm::normalize(view.forward + aside), INFINITY};
    for_each_effect(all_effects{}, [&](auto effect) {
      using type = decltype(effect);
      if constexpr (Set::template has<type>) {
        if constexpr (detail::changes_camera_rays<type>) type::camera_ray(view, batch.random(i), r);
        if constexpr (path_array<type, Set>::exists) batch.template state<type>(i) = {};
      }
    });
    batch.origin[i] = r.origin;
    batch.direction[i] = r.direction;
    batch.throughput[i] = vec3{1};
    batch.radiance[i] = vec3{0};
    batch.pdf[i] = 0;
  }
};

/// Finds what each ray hits, and with it the shader to run.
template <class Set>
struct find_hits {
  batch_view<Set> batch;
  scene_view scene;

  PT_HD void operator()(request_index i) const {
    batch.shadow_light[i] = vec3{0};
    if (batch.throughput[i] == vec3{0}) {
      batch.id[i] = finished;
      return;
    }
    real const time = time_of<Set>(batch, i);
    hit const h = find_hit<Set, false>(scene.bvh, scene.motion,
                                       {batch.origin[i], batch.direction[i], INFINITY}, time);
    batch.primitive[i] = h.primitive;
    batch.barycentric[i] = h.barycentric;
    shader kind = h.primitive == no_primitive
                      ? miss
                      : scene.materials[scene.triangles[h.primitive].material].kind;
    if constexpr (Set::template has<effects::medium>) {
      if (scene.medium.extinction != vec3{0} && !inside_glass(i, h, kind, time)) {
        if (effects::medium::scatters(batch, scene.medium, i, h.t))
          kind = shader_of<effects::medium>;
        if (batch.throughput[i] == vec3{0}) {
          batch.id[i] = finished;
          return;
        }
      }
    }
    batch.id[i] = static_cast<std::uint8_t>(kind);
  }

 private:
  PT_HD bool inside_glass(request_index i, hit const& h, shader kind, real time) const {
    bool const glass =
        kind == shader_of<effects::smooth_glass> || kind == shader_of<effects::rough_glass>;
    if (!glass || scene.materials[scene.triangles[h.primitive].material].thin) return false;
    loaded_triangle<Set> t = load_triangle<Set>(scene.triangles, scene.motion, h.primitive, time);
    return glm::dot(geometric_normal(t), vec3(batch.direction[i])) > 0;
  }
};

/// Traces the shadow rays and adds the light that arrives.
template <class Set>
struct trace_shadows {
  basic_batch batch;
  scene_view scene;

  PT_HD void operator()(request_index i) const {
    if (batch.shadow_light[i] == vec3{0}) return;
    ray const r{batch.shadow_origin[i], batch.shadow_vector[i], 1};
    real const time = time_of<Set>(batch, i);
    if (find_hit<Set, true>(scene.bvh, scene.motion, r, time).primitive == no_primitive)
      batch.radiance[i] += batch.shadow_light[i];
    else if constexpr (Set::template has<effects::smooth_glass>)
      if (scene.has_panes) batch.radiance[i] += batch.shadow_light[i] * through_panes(r, time);
  }

 private:
  /// The share of light that passes all that a ray meets, if these are panes; else 0.
  PT_HD vec3 through_panes(ray r, real time) const {
    vec3 const end = r.origin + r.direction;
    vec3 share{1};
    for (int panes = 0; panes < most_panes; ++panes) {
      hit const h = find_hit<Set, false>(scene.bvh, scene.motion, r, time);
      if (h.primitive == no_primitive) return share;
      loaded_triangle<Set> t = load_triangle<Set>(scene.triangles, scene.motion, h.primitive, time);
      material const& m = scene.materials[t.material];
      if (!m.thin || m.kind != shader_of<effects::smooth_glass>) return vec3{0};
      surface const s = load_surface<Set>(scene, t, h.barycentric, glm::normalize(r.direction));
      share *= effects::smooth_glass::straight(shading_point<Set>(scene, s, t));
      r.origin = s.start_towards(r.direction);
      r.direction = end - r.origin;
    }
    return vec3{0};
  }
  static constexpr int most_panes = 64;
};

/// How many paths of a batch go on after a bounce, and how many had a shadow ray there.
struct ray_count {
  std::uint32_t extended, shadow;

  /// From the sum of count_rays over the batch.
  static ray_count unpacked(std::uint64_t sum) {
    return {static_cast<std::uint32_t>(sum), static_cast<std::uint32_t>(sum >> 32)};
  }
};

/// Both counts of a path in one number, so that one reduction finds them.
struct count_rays {
  basic_batch batch;

  PT_HD std::uint64_t operator()(request_index i) const {
    std::uint64_t const extended = batch.throughput[i] == vec3{0} ? 0 : 1;
    std::uint64_t const shadow = batch.shadow_light[i] == vec3{0} ? 0 : 1;
    return shadow << 32 | extended;
  }
};

PT_HD inline bool is_finite(vec3 c) {
  real const total = c.x + c.y + c.z;
  return total - total == 0;
}

/// Adds a batch's samples of a pixel to its sum, in the order of the samples: the picture does not
/// depend on the size of a batch. Leaves out samples that are not finite. Runs over the pixels of
/// the batch, at most one per path.
template <class Sum>
struct accumulate_samples {
  basic_batch batch;
  std::uint32_t paths;
  Sum* sums;

  PT_HD void operator()(request_index i) const {
    Sum& sum = sums[batch.pixel(i)];
    for (std::uint64_t k = i; k < paths; k += batch.pixels)
      if (is_finite(batch.radiance[k])) sum.add(batch.radiance[k]);
  }
};

/// 1 for a sample that accumulate_samples leaves out.
struct count_discarded {
  basic_batch batch;

  PT_HD std::uint64_t operator()(request_index i) const {
    return is_finite(batch.radiance[i]) ? 0 : 1;
  }
};

}  // namespace path_tracer
