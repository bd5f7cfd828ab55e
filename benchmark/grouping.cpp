// SPDX-License-Identifier: Apache-2.0
// Grouping alone: ids of 8 bits to a stable permutation, next to what a renderer would do without
// the library, and to a copy (baselines.hpp).
// The names of cells: shaders / way to group / n: requests / run: mean length of a stretch of one
// id. benchmark/ratios.py makes tables of them.
#include <thrust/transform_reduce.h>

#include "axes.hpp"
#include "baselines.hpp"
#include "batch.hpp"

namespace {

namespace ds = bench::ds;
using bench::request_index;

template <ds::shader_id Shaders>
struct bucket {
  request_index n;
  ds::grouping operator()(std::uint8_t const* ids) const {
    return ds::group_by_bucket<Shaders>(bench::policy(), n, ids, bench::scratch());
  }
};

template <ds::shader_id Shaders>
struct radix_sort {
  request_index n;
  ds::grouping operator()(std::uint8_t const* ids) const {
    return ds::group_by_radix_sort<Shaders>(bench::policy(), n, ids, bench::scratch());
  }
};

template <ds::shader_id Shaders>
struct compaction {
  request_index n;
  ds::grouping operator()(std::uint8_t const* ids) const {
    return ds::group_by_compaction<Shaders>(bench::policy(), n, ids, bench::scratch());
  }
};

/// Whether position p of a grouping does not follow on the one before, or lies outside its segment.
struct misplaced {
  std::uint8_t const* ids;
  ds::grouping group;
  request_index n;
  DEFERRED_SHADE_HOST_DEVICE int operator()(request_index p) const {
    request_index const i = group.permutation[p];
    if (i >= n) return 1;
    std::uint8_t const id = ids[i];
    if (group.offsets != nullptr && (p < group.offsets[id] || p >= group.offsets[id + 1])) return 1;
    if (p == 0) return 0;
    request_index const before = group.permutation[p - 1];
    if (before >= n) return 1;
    return ids[before] < id || (ids[before] == id && before < i) ? 0 : 1;
  }
};

/// Whether a way to group finds the stable grouping: n positions of which each follows on the one
/// before are all different, and so hold every request.
template <class Group>
bool is_right(Group& group, std::uint8_t const* ids, std::size_t n) {
  if constexpr (std::is_same_v<decltype(group(ids)), ds::grouping>) {
    thrust::counting_iterator<request_index> const positions(0);
    misplaced const wrong{ids, group(ids), static_cast<request_index>(n)};
    return thrust::transform_reduce(bench::policy(), positions,
                                    positions + static_cast<std::ptrdiff_t>(n), wrong, 0,
                                    thrust::plus<int>{}) == 0;
  } else {
    group(ids);
    return group.is_right(ids);
  }
}

/// What varies from cell to cell.
struct batch_shape {
  ds::shader_id shaders;
  std::size_t n;
  std::uint32_t run;
};

template <class Make>
void add(batch_shape shape, std::string const& name, Make make) {
  bench::add_cell(
      std::to_string(shape.shaders) + " shaders/" + name + bench::name_of(shape.n, shape.run),
      [=](benchmark::State& state) {
        auto const ids = bench::make_ids(shape.n, shape.shaders, shape.run);
        auto group = make(shape);
        if (!bench::check(state, is_right(group, bench::raw(ids), shape.n))) return;
        bench::measure(state, shape.n, [&] { group(bench::raw(ids)); });
      });
}

/// A way to group that is made for a number of requests, or for that and a number of shaders.
template <class Group>
auto for_size() {
  return [](batch_shape shape) { return Group{static_cast<request_index>(shape.n)}; };
}
template <class Group>
auto for_shape() {
  return [](batch_shape shape) { return Group(shape.n, shape.shaders); };
}

template <ds::shader_id Shaders>
void add_all(std::size_t n, std::uint32_t run) {
  batch_shape const shape{Shaders, n, run};
  add(shape, "copy-5-bytes", for_shape<bench::copy_5_bytes>());
  add(shape, "bucket", for_size<bucket<Shaders>>());
  add(shape, "radix-sort", for_size<radix_sort<Shaders>>());
  // One pass per shader, and memory for all requests per shader: not for large tables.
  if constexpr (Shaders <= 32) add(shape, "compaction", for_size<compaction<Shaders>>());
#ifdef __CUDACC__
  if constexpr (Shaders <= 32) add(shape, "queue-push", for_shape<bench::queue_push>());
  add(shape, "cub-radix-sort", for_shape<bench::cub_radix_sort>());
#endif
  add(shape, "thrust-sort-u32", for_shape<bench::thrust_sort>());
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run(argc, argv, [](bool quick) {
    auto const [sizes, runs] = bench::grouping_axes(quick);
    for (std::size_t const n : sizes) {
      for (std::uint32_t const run : runs) {
        add_all<4>(n, run);
        add_all<11>(n, run);
        add_all<32>(n, run);
        add_all<256>(n, run);
      }
    }
  });
}
