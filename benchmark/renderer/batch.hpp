// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../machine.hpp"
#include "path.hpp"

namespace renderer {

using bench::array;
using bench::raw;
using bench::request_index;

/// The arrays of a batch: what kernels get.
struct views {
  path* paths;
  hit* hits;
  std::uint8_t* ids;
};

/// The arrays of a batch, and what belongs to them.
struct arrays {
  explicit arrays(std::size_t n) : paths(n), hits(n), ids(n) {}
  views all() { return {raw(paths), raw(hits), raw(ids)}; }

  array<path> paths;
  array<hit> hits;
  array<std::uint8_t> ids;
};

struct begin_paths {
  views to;
  scene in;
  __device__ void operator()(request_index i) const {
    path p;
    hit h;
    to.ids[i] = begin_path(i, p, h, in);
    to.paths[i] = p;
    to.hits[i] = h;
    for (int c = 0; c < 3; ++c) in.film[3 * std::size_t{i} + c] = -1;
  }
};

/// A frame: paths that have hit something for the first time. Two sets of arrays, since some loops
/// move their paths.
struct frame {
  frame(std::size_t n_, std::uint32_t materials, double survival)
      : n(n_),
        film(3 * n_),
        now(n_),
        next(n_),
        in{raw(film), static_cast<std::uint64_t>(survival * 0x1p32), materials} {}

  void begin() { bench::for_each_request(n, begin_paths{now.all(), in}); }

  std::size_t n;
  array<float> film;
  arrays now, next;
  scene in;
};

/// The radiance of the first `count` pixels, by a plain loop on the host.
template <std::uint32_t Materials>
std::vector<float> plain_loop(frame const& f, std::size_t count) {
  std::vector<float> film(3 * count);
  scene in = f.in;
  in.film = film.data();
  for (std::size_t i = 0; i < count; ++i) {
    path p;
    hit h;
    std::uint8_t id = begin_path(static_cast<std::uint32_t>(i), p, h, in);
    while (id != ended) id = shade_by_switch<Materials>(id, p, h, in);
  }
  return film;
}

}  // namespace renderer
