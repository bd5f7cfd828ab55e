// SPDX-License-Identifier: Apache-2.0
#pragma once

// A machine is the CPU or a GPU. Pictures of one machine have the same bits whatever runs them;
// those of two machines differ by the rounding of their sine, cosine, power and exponential.

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "render_support.hpp"

namespace path_tracer {

/// The backend that stands for the machine of `backend`: one on which --threads has no effect.
inline std::string machine_of(std::string_view backend) {
  return backend == "cuda" ? "cuda" : "cpp";
}

/// The machines of this build; the CPU is the first.
inline std::vector<std::string> machines() {
  std::vector<std::string> result = {"cpp"};
  for (std::string_view const name : backends())
    if (machine_of(name) != "cpp") result.push_back(machine_of(name));
  return result;
}

/// Checks that all schedules, backends and numbers of threads give the same bits on a machine.
inline void check_same_bits(scene const& s, render_settings settings,
                            std::vector<unsigned> const& thread_counts) {
  std::map<std::string, render_result> references;
  settings.schedule = "implicit";
  for (std::string const& machine : machines()) {
    settings.backend = machine;
    references[machine] = render(s, settings);
    CHECK(references[machine].discarded_samples == 0);
  }
  for (auto const backend : backends()) {
    bool const has_threads = backend != machine_of(backend);
    for (unsigned const threads : has_threads ? thread_counts : std::vector<unsigned>{0})
      for (auto const schedule : schedules()) {
        CAPTURE(backend, schedule, threads);
        settings.backend = backend;
        settings.schedule = schedule;
        settings.threads = threads;
        CHECK(same_bits(render(s, settings), references[machine_of(backend)]));
      }
  }
}

/// How much alike two pictures of a scene are.
struct likeness {
  double same_pixels;  ///< the share of pixels that differ by less than a thousandth
  double mean_ratio;   ///< the mean of the second picture over that of the first
};

inline likeness compare(render_result const& a, render_result const& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  std::size_t same = 0;
  double sum_a = 0, sum_b = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    vec3 const p = a.pixels[i], q = b.pixels[i], bound = 1e-3f * glm::max(p, q) + 1e-6f;
    if (glm::all(glm::lessThanEqual(glm::abs(p - q), bound))) ++same;
    sum_a += double{p.x} + double{p.y} + double{p.z};
    sum_b += double{q.x} + double{q.y} + double{q.z};
  }
  return {static_cast<double>(same) / static_cast<double>(a.pixels.size()), sum_b / sum_a};
}

}  // namespace path_tracer
