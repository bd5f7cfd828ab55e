// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "scene/environment_map.hpp"
#include "scene/math.hpp"
#include "scene/motion.hpp"
#include "scene/scene.hpp"
#include "scene/texture.hpp"
#include "shading/accuracy.hpp"

namespace path_tracer {

/// A column of an alias table (Walker 1977): picks its own light with probability `keep`, else
/// `alias`. `probability` is the total probability of its own light.
struct light_entry {
  real keep;
  std::uint32_t alias;
  real probability;
  std::uint32_t index;  ///< of a triangle, or of a punctual light
};

/// The lights of a scene: first the emissive triangles, then the punctual lights, then the
/// environment, where there is one.
struct light_view {
  light_entry const* entries;
  std::uint32_t count;
  std::uint32_t triangle_count;  ///< how many of the entries are triangles
  std::uint32_t sky_entry;       ///< which of them is the environment; `count`: none
  triangle const* triangles;
  material const* materials;
  triangle_motion const* motion;  ///< null: nothing moves
  punctual_light const* punctual;
  texture_view textures;
  environment_view sky;
  light_entry const* sky_entries;  ///< one for each of its texels
  real root_per_power;             ///< its square: probability of a light per unit of its power
  estimator how;                   ///< which of two ways to find a light counts
  real far_away;                   ///< a distance that leaves the scene from anywhere in it
};

/// The lights in host memory.
class light_list {
 public:
  light_list() = default;
  /// Picks each light in proportion to its power, except for lights that an estimator does not
  /// sample.
  explicit light_list(scene const& s, estimator how = estimator::mis);
  /// The scene is the one that it was made of.
  light_view view(scene const& s) const;

 private:
  std::vector<light_entry> entries_, sky_entries_;
  std::uint32_t triangle_count_ = 0, sky_entry_ = 0;
  real root_per_power_ = 0, far_away_ = 0;
  estimator how_ = estimator::mis;

  /// Fills sky_entries_; returns the integral of the environment's luminance over all directions.
  double list_sky(scene const& s);
};

/// Power per unit area of an emissive surface, by the mean of its texture.
PT_HD inline real radiosity(material const& m) {
  return pi * luminance(m.emission * m.mean_emissive) * (m.two_sided ? real(2) : real(1));
}

/// The radiance of a point of an emissive surface.
template <class Set>
PT_HD vec3 emission_at(texture_view const& textures, material const& m, vec2 uv) {
  if constexpr (Set::template has<effects::textures>) {
    if (m.emissive_texture != no_texture)
      return m.emission * vec3(sample_texture(textures, m.emissive_texture, uv));
  }
  return m.emission;
}

struct light_sample {
  vec3 wi{0, 0, 1};  ///< unit direction to the light
  real distance = 0;
  vec3 radiance{0};    ///< or for a punctual light, what arrives per unit of solid angle 1
  vec3 clearance{0};   ///< from an emissive triangle to where a shadow ray can end, see motion.hpp
  real pdf = 0;        ///< per solid angle; of a punctual light, its probability
  bool delta = false;  ///< a punctual light: no other strategy can find it
};

/// The density per solid angle with which sample_light finds a point of an emissive surface.
PT_HD inline real light_pdf(light_view const& lights, material const& m, real distance2,
                            real cos_light) {
  // Of dim, small lights, the square itself is beyond the range of a float.
  real const root = lights.root_per_power;
  return radiosity(m) * root * distance2 * root / cos_light;
}

/// What a punctual light sends to `p` (KHR_lights_punctual).
PT_HD inline light_sample sample_punctual(punctual_light const& light, vec3 p, real far_away) {
  light_sample s;
  s.delta = true;
  if (light.kind == punctual_light::type::directional) {
    s.wi = -light.direction;
    s.distance = far_away;
    s.radiance = light.intensity;
    return s;
  }
  vec3 const to_light = light.position - p;
  real const d2 = glm::dot(to_light, to_light);
  if (!(d2 > 0)) return s;
  s.distance = std::sqrt(d2);
  s.wi = to_light / s.distance;
  real falloff = 1 / d2;
  if (light.range > 0) {
    real const ratio2 = d2 / (light.range * light.range);
    falloff *= glm::clamp(1 - ratio2 * ratio2, real(0), real(1));
  }
  if (light.kind == punctual_light::type::spot) {
    real const width = glm::max(real(1e-3), light.cos_inner - light.cos_outer);
    real const a =
        glm::clamp((-glm::dot(s.wi, light.direction) - light.cos_outer) / width, real(0), real(1));
    falloff *= a * a;
  }
  s.radiance = light.intensity * falloff;
  return s;
}

/// A direction from `p` to a point of an emissive triangle.
template <class Set>
PT_HD light_sample sample_emitter(light_view const& lights, triangle const& t, material const& m,
                                  vec3 p, vec2 place) {
  real const root = std::sqrt(place.x);
  real const b1 = root * (1 - place.y), b2 = root * place.y;
  vec3 const e1 = t.position[1] - t.position[0], e2 = t.position[2] - t.position[0];
  vec3 const to_light = t.position[0] + b1 * e1 + b2 * e2 - p;
  real const d2 = glm::dot(to_light, to_light);
  light_sample s;
  if (!(d2 > 0)) return s;
  s.distance = std::sqrt(d2);
  s.wi = to_light / s.distance;
  vec3 normal = glm::normalize(glm::cross(e1, e2));
  real cos_light = -glm::dot(s.wi, normal);
  if (cos_light < 0 && m.two_sided) {
    cos_light = -cos_light;
    normal = -normal;
  }
  if (!(cos_light > 0)) return s;
  s.clearance = normal * (clearance_of(t) + 4 * epsilon * s.distance);
  vec2 const uv = (1 - b1 - b2) * t.uv[0] + b1 * t.uv[1] + b2 * t.uv[2];
  s.radiance = emission_at<Set>(lights.textures, m, uv);
  s.pdf = light_pdf(lights, m, d2, cos_light);
  return s;
}

/// The column of an alias table that two numbers in [0, 1) pick. The unused bits of the first
/// refine the second, whose 24 bits alone would pick a rare light too often.
PT_HD inline std::uint32_t pick_entry(light_entry const* entries, std::uint32_t count, vec2 u) {
  real const x = u.x * static_cast<real>(count);
  auto slot = static_cast<std::uint32_t>(x);
  slot = slot < count ? slot : count - 1;
  real const rest = glm::min(x - static_cast<real>(slot), real(1));
  return u.y + rest * real(0x1p-24) >= entries[slot].keep ? entries[slot].alias : slot;
}

/// The density per solid angle with which sample_light takes a direction of the environment, at
/// coordinates `uv` of its picture.
PT_HD inline real sky_pdf(light_view const& lights, vec2 uv) {
  if (lights.sky_entry == lights.count) return 0;
  environment_view const& sky = lights.sky;
  auto const texels = static_cast<real>(sky.width) * static_cast<real>(sky.height);
  real const sine = std::sin(pi * uv.y);
  real const share = lights.entries[lights.sky_entry].probability *
                     lights.sky_entries[sky.texel_at(uv)].probability;
  return sine > 0 ? share * texels / (2 * pi * pi * sine) : real(0);
}

/// A direction from which the environment shines.
PT_HD inline light_sample sample_sky(light_view const& lights, vec2 pick, vec2 place) {
  environment_view const& sky = lights.sky;
  std::uint32_t const texel = pick_entry(lights.sky_entries, sky.width * sky.height, pick);
  vec2 const uv{(static_cast<real>(texel % sky.width) + place.x) / static_cast<real>(sky.width),
                (static_cast<real>(texel / sky.width) + place.y) / static_cast<real>(sky.height)};
  light_sample s;
  s.wi = sky.direction(uv);
  s.distance = lights.far_away;
  s.radiance = sky.radiance(uv);
  s.pdf = sky_pdf(lights, uv);
  return s;
}

/// The random numbers of a light sample: which light, which point of it, and of the environment,
/// which texel; and the moment of the path.
struct light_draws {
  vec2 pick, place, texel;
  real time;
};

/// A direction from `p` to a light of the kinds that `Set` has.
template <class Set>
PT_HD light_sample sample_light(light_view const& lights, vec3 p, light_draws const& u) {
  std::uint32_t const slot = pick_entry(lights.entries, lights.count, u.pick);
  light_entry const entry = lights.entries[slot];
  if constexpr (Set::template has<effects::environment>) {
    if (slot == lights.sky_entry) return sample_sky(lights, u.texel, u.place);
  }
  if constexpr (Set::template has<effects::punctual_lights>) {
    if (slot >= lights.triangle_count) {
      light_sample s = sample_punctual(lights.punctual[entry.index], p, lights.far_away);
      s.pdf = entry.probability;
      return s;
    }
  }
  loaded_triangle<Set> t = load_triangle<Set>(lights.triangles, lights.motion, entry.index, u.time);
  light_sample s = sample_emitter<Set>(lights, t, lights.materials[t.material], p, u.place);
  s.pdf *= area_ratio<Set>(lights.triangles, lights.motion, entry.index, t);
  return s;
}

/// The power heuristic (Veach 1997, section 9.2) of a strategy of density `a` against one of `b`.
PT_HD inline real power_heuristic(real a, real b) {
  real const ratio = b / a;
  return 1 / (1 + ratio * ratio);
}

/// The weight of a light sample of density `light`, in a direction that the BSDF takes with density
/// `bsdf`.
PT_HD inline real weight_of_light(estimator how, real light, real bsdf) {
  return how == estimator::mis ? power_heuristic(light, bsdf) : real(1);
}

/// The weight of light that was found by a BSDF sample of density `bsdf`, where light samples have
/// the density `light`.
PT_HD inline real weight_of_bsdf(estimator how, real bsdf, real light) {
  if (how == estimator::mis) return power_heuristic(bsdf, light);
  return how == estimator::light && light > 0 ? real(0) : real(1);
}

}  // namespace path_tracer
