// SPDX-License-Identifier: Apache-2.0
// A renderer with kernels and path states of its own, on a GPU: eight bounces over arrays of
// structs, 80 bytes a path, by
//   unsorted   one kernel with a switch; paths that have ended stay
//   thrust     thrust::sort_by_key of the structs and thrust::partition
//   queues     a queue per material, filled by atomics
//   bucket, window   `shade` by a schedule; paths that have ended stay
//   gather     group, gather, and a kernel over all segments
//   group      group, and a kernel that reads through the permutation and writes in its order
// The names of cells: materials / survival per bounce / way / n. The material of a hit is random.
#include <algorithm>
#include <memory>
#include <string>

#include "axes.hpp"
#include "renderer/library.hpp"

namespace {

/// The frame of the cells that are running, with the film that is right; consecutive cells share
/// it.
struct current_frame {
  std::string name;
  std::unique_ptr<renderer::frame> frame;
  std::vector<float> film;
};

template <std::uint32_t Materials>
bool take_reference(current_frame& current) {
  renderer::frame& f = *current.frame;
  f.begin();
  renderer::unsorted<Materials>{}(f);
  current.film.resize(3 * f.n);
  thrust::copy(f.film.begin(), f.film.end(), current.film.begin());
  auto const expected = renderer::plain_loop<Materials>(f, (std::min)(f.n, std::size_t{65536}));
  return std::equal(expected.begin(), expected.end(), current.film.begin());
}

/// The median time of a frame's bounces, without its beginning.
template <class Loop>
void measure(benchmark::State& state, renderer::frame& f, Loop& loop) {
  std::vector<double> seconds;
  for (auto _ : state) {
    for (int call = 0; call < 13; ++call) {
      f.begin();
      double const time = bench::seconds_per_call([&] { loop(f); }, 1)[0];
      if (call >= 2) seconds.push_back(time);
    }
    std::sort(seconds.begin(), seconds.end());
    state.SetIterationTime(seconds[seconds.size() / 2]);
    state.counters["p10_us"] = 1e6 * seconds[1];
    state.counters["p90_us"] = 1e6 * seconds[seconds.size() - 2];
  }
}

template <std::uint32_t Materials, class MakeLoop>
void add_way(current_frame& current, char const* way, std::size_t n, int survival,
             MakeLoop const& make_loop) {
  std::string const name =
      std::to_string(Materials) + " materials/" + std::to_string(survival) + " %";
  bench::add_cell(name + "/" + way + "/n:" + std::to_string(n), [=, &current](auto& state) {
    std::string const frame_name = name + std::to_string(n);
    if (current.name != frame_name) {
      current = {};
      current.frame = std::make_unique<renderer::frame>(n, Materials, survival / 100.0);
      if (!bench::check(state, take_reference<Materials>(current))) return;
      current.name = frame_name;
    }
    renderer::frame& f = *current.frame;
    auto loop = make_loop(n);
    f.begin();
    loop(f);
    std::vector<float> film(3 * n);
    thrust::copy(f.film.begin(), f.film.end(), film.begin());
    if (bench::check(state, film == current.film)) measure(state, f, loop);
  });
}

template <std::uint32_t Materials>
void add_cells(current_frame& current, std::size_t n, int survival) {
  using namespace renderer;
  using ds_bucket = deferred_shade::bucket_then_dispatch<>;
  using ds_window = deferred_shade::window_sort_then_dispatch;
  auto const add = [&](char const* way, auto const& make) {
    add_way<Materials>(current, way, n, survival, make);
  };
  add("unsorted", [](std::size_t) { return unsorted<Materials>{}; });
  add("thrust", [](std::size_t) { return thrust_sort<Materials>{}; });
  add("queues", [](std::size_t size) { return material_queues<Materials>{size}; });
  add("bucket", [](std::size_t) { return scheduled<Materials, ds_bucket>{}; });
  add("window", [](std::size_t) { return scheduled<Materials, ds_window>{}; });
  add("gather", [](std::size_t) { return grouped<Materials, true>{}; });
  add("group", [](std::size_t) { return grouped<Materials, false>{}; });
}

}  // namespace

int main(int argc, char** argv) {
  current_frame current;
  return bench::run(argc, argv, [&](bool quick) {
    using bench::operator""_mi;
    auto const sizes = quick ? std::vector{1_mi / 8} : std::vector{1_mi, 8_mi};
    for (std::size_t const n : sizes) {
      for (int const survival : {100, 70, 30}) {
        add_cells<1>(current, n, survival);
        add_cells<3>(current, n, survival);
        add_cells<6>(current, n, survival);
        add_cells<12>(current, n, survival);
      }
    }
  });
}
