// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/binary_search.h>
#include <thrust/copy.h>
#include <thrust/fill.h>
#include <thrust/functional.h>
#include <thrust/gather.h>
#include <thrust/host_vector.h>
#include <thrust/inner_product.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/permutation_iterator.h>
#include <thrust/sequence.h>
#include <thrust/sort.h>
#include <thrust/tabulate.h>
#include <thrust/transform_scan.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "machine.hpp"
#include "shaders.hpp"

namespace bench {

/// A random number that depends on a request and a dimension alone: requests are made in parallel,
/// and a smaller batch is the beginning of a larger one.
DEFERRED_SHADE_HOST_DEVICE inline std::uint32_t random_bits(request_index i, std::uint32_t dim) {
  return mixed(mixed(i + 1) + dim * 0x9e3779b1U);
}

/// The request at which the stretch of one id begins that holds request i, where it begins at i;
/// else 0.
struct stretch_begin {
  std::uint32_t mean_length;
  DEFERRED_SHADE_HOST_DEVICE request_index operator()(request_index i) const {
    return random_bits(i, 0) % mean_length == 0 ? i : 0;
  }
};

struct larger {
  DEFERRED_SHADE_HOST_DEVICE request_index operator()(request_index a, request_index b) const {
    return a < b ? b : a;
  }
};

struct id_of_stretch {
  std::uint32_t shaders;
  DEFERRED_SHADE_HOST_DEVICE std::uint8_t operator()(request_index begin) const {
    return static_cast<std::uint8_t>(random_bits(begin, 1) % shaders);
  }
};

/// `n` ids over up to 256 shaders, in stretches that are `mean_length` long on average; the lengths
/// have a geometric distribution.
inline array<std::uint8_t> make_ids(std::size_t n, ds::shader_id shaders,
                                    std::uint32_t mean_length) {
  array<request_index> begins(n);
  thrust::counting_iterator<request_index> const requests(0);
  thrust::transform_inclusive_scan(policy(), requests, requests + static_cast<std::ptrdiff_t>(n),
                                   begins.begin(), stretch_begin{mean_length}, larger{});
  array<std::uint8_t> ids(n);
  thrust::transform(policy(), begins.begin(), begins.end(), ids.begin(), id_of_stretch{shaders});
  return ids;
}

struct uneven_id {
  std::uint32_t shaders;
  DEFERRED_SHADE_HOST_DEVICE std::uint8_t operator()(request_index i) const {
    std::uint32_t const rare = 1 + random_bits(i, 1) % (shaders - 1);
    return static_cast<std::uint8_t>(random_bits(i, 0) % 100 < 95 ? 0 : rare);
  }
};

/// `n` ids in any order, 95 of 100 of shader 0, the others of the other shaders alike.
inline array<std::uint8_t> make_uneven_ids(std::size_t n, ds::shader_id shaders) {
  array<std::uint8_t> ids(n);
  thrust::tabulate(policy(), ids.begin(), ids.end(), uneven_id{shaders});
  return ids;
}

struct make_request {
  DEFERRED_SHADE_HOST_DEVICE request operator()(std::size_t index) const {
    auto const i = static_cast<request_index>(index);
    auto const random = [i](std::uint32_t dim) { return 2 * uniform(random_bits(i, dim)) - 1; };
    float const x = random(2);
    float const y = random(3);
    float const z = random(4);
    float const length = std::sqrt(x * x + y * y + z * z + 1e-8F);
    return {{random(5), random(6), random(7)},
            random(8),
            {x / length, y / length, z / length},
            random(9)};
  }
};

struct sample_index {
  std::size_t n;
  DEFERRED_SHADE_HOST_DEVICE request_index operator()(std::size_t i) const {
    return static_cast<request_index>(random_bits(static_cast<request_index>(i), 10) % n);
  }
};

/// Whether two results are not the same to the last bit.
struct differ {
  DEFERRED_SHADE_HOST_DEVICE int operator()(result const& a, result const& b) const {
    std::uint32_t words[2][4];
    std::memcpy(words[0], &a, sizeof(result));
    std::memcpy(words[1], &b, sizeof(result));
    std::uint32_t bits = 0;
    for (int w = 0; w < 4; ++w) bits |= words[0][w] ^ words[1][w];
    return bits == 0 ? 0 : 1;
  }
};

/// Whether two results are the same but for the rounding of a host's and a device's functions.
inline bool close(result const& a, result const& b) {
  auto const near = [](float x, float y) {
    return std::fabs(x - y) <= 1e-3F * std::max({1.0F, std::fabs(x), std::fabs(y)});
  };
  return near(a.radiance[0], b.radiance[0]) && near(a.radiance[1], b.radiance[1]) &&
         near(a.radiance[2], b.radiance[2]) && near(a.throughput, b.throughput);
}

/// What a row of the benchmark is given.
struct view {
  std::size_t n;
  std::uint8_t const* ids;
  request const* requests;
  result* results;
  /// On the host: the first request of every shader once they are sorted, and n.
  request_index const* offsets;
};

/// The requests of one cell: as they come, and sorted by shader.
class batch {
 public:
  batch(std::size_t n, ds::shader_id shaders, std::uint32_t run)
      : batch(make_ids(n, shaders, run), shaders) {}

  batch(array<std::uint8_t> const& ids, ds::shader_id shaders)
      : ids_(ids),
        requests_(ids.size()),
        sorted_ids_(ids),
        sorted_requests_(ids.size()),
        order_(ids.size()),
        results_(ids.size()),
        expected_(ids.size()) {
    thrust::tabulate(policy(), requests_.begin(), requests_.end(), make_request{});
    thrust::sequence(policy(), order_.begin(), order_.end());
    thrust::stable_sort_by_key(policy(), sorted_ids_.begin(), sorted_ids_.end(), order_.begin());
    thrust::gather(policy(), order_.begin(), order_.end(), requests_.begin(),
                   sorted_requests_.begin());
    array<std::uint8_t> table(shaders);
    thrust::sequence(policy(), table.begin(), table.end());
    array<request_index> first(shaders);
    thrust::lower_bound(policy(), sorted_ids_.begin(), sorted_ids_.end(), table.begin(),
                        table.end(), first.begin());
    offsets_ = first;
    offsets_.push_back(static_cast<request_index>(ids.size()));
  }

  /// The requests as they come, or sorted.
  view requests(bool sorted) {
    return {results_.size(), raw(sorted ? sorted_ids_ : ids_),
            raw(sorted ? sorted_requests_ : requests_), raw(results_), offsets_.data()};
  }

  /// Takes the results of `shade`, a schedule, as those that all others must give. Whether they are
  /// right: whether a sample of them is what `plain_loop` computes on the host.
  template <class Shade, class PlainLoop>
  bool take_reference(Shade const& shade, PlainLoop const& plain_loop) {
    forget();
    shade(requests(false));
    expected_ = results_;

    array<request_index> positions(std::min(ids_.size(), std::size_t{10000}));
    thrust::tabulate(policy(), positions.begin(), positions.end(), sample_index{ids_.size()});
    thrust::host_vector<std::uint8_t> const ids = sample(positions, ids_);
    thrust::host_vector<request> const requests = sample(positions, requests_);
    thrust::host_vector<result> const given = sample(positions, expected_);
    thrust::host_vector<result> computed(positions.size());
    plain_loop(view{positions.size(), ids.data(), requests.data(), computed.data(), nullptr});
    return std::equal(given.begin(), given.end(), computed.begin(), close);
  }

  /// Whether `shade` gives the results of the reference, bit by bit.
  template <class Shade>
  bool agrees(Shade const& shade, bool sorted) {
    forget();
    shade(requests(sorted));
    auto const wrong = [this](auto expected) {
      return thrust::inner_product(policy(), results_.begin(), results_.end(), expected, 0,
                                   thrust::plus<int>{}, differ{});
    };
    auto const in_order = thrust::make_permutation_iterator(expected_.begin(), order_.begin());
    return (sorted ? wrong(in_order) : wrong(expected_.begin())) == 0;
  }

 private:
  // So that no request that a schedule forgets has its result from the schedule before.
  void forget() {
    thrust::fill(policy(), results_.begin(), results_.end(), result{{-1e9F, -1e9F, -1e9F}, -1e9F});
  }

  template <class T>
  static thrust::host_vector<T> sample(array<request_index> const& positions,
                                       array<T> const& from) {
    array<T> taken(positions.size());
    thrust::gather(policy(), positions.begin(), positions.end(), from.begin(), taken.begin());
    return taken;
  }

  array<std::uint8_t> ids_;
  array<request> requests_;
  array<std::uint8_t> sorted_ids_;
  array<request> sorted_requests_;
  array<request_index> order_;
  array<result> results_;
  array<result> expected_;
  thrust::host_vector<request_index> offsets_;
};

}  // namespace bench
