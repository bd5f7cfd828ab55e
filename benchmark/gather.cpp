// SPDX-License-Identifier: Apache-2.0
// Arrays of structs in another order, on a GPU: `gather`, `scatter`, and as controls a copy of as
// many bytes and thrust::gather, a thread for each struct. Orders are random within windows of 2^17
// places, or over the whole batch. The names of cells: bytes of a struct / order / way / n.
#include <thrust/gather.h>
#include <thrust/sort.h>
#include <thrust/tabulate.h>
#include <memory>
#include <string>

#include "axes.hpp"
#include "batch.hpp"

namespace {

using bench::array;
using bench::raw;
using ds_index = bench::request_index;
namespace ds = deferred_shade;

template <int Bytes>
struct alignas(16) element {
  std::uint32_t words[Bytes / 4];
};

template <int Bytes>
struct make_element {
  __device__ element<Bytes> operator()(std::size_t i) const {
    element<Bytes> e;
    for (int w = 0; w < Bytes / 4; ++w) {
      e.words[w] = static_cast<std::uint32_t>(i) * 31 + static_cast<std::uint32_t>(w);
    }
    return e;
  }
};

/// Random, but for the upper bits of the window.
struct make_key {
  std::size_t window;
  __device__ std::uint64_t operator()(std::size_t i) const {
    return (i / window) << 32 | bench::random_bits(static_cast<ds_index>(i), 3);
  }
};

/// Whether word w of the element at place p is what it was at permutation[p].
template <int Bytes>
struct is_wrong {
  element<Bytes> const* elements;
  ds_index const* permutation;
  bool scattered;
  __device__ int operator()(ds_index p) const {
    ds_index const i = permutation[p];
    element<Bytes> const expected = make_element<Bytes>{}(scattered ? p : i);
    element<Bytes> const& e = elements[scattered ? i : p];
    for (int w = 0; w < Bytes / 4; ++w) {
      if (e.words[w] != expected.words[w]) return 1;
    }
    return 0;
  }
};

template <int Bytes>
struct moving {
  moving(std::size_t n, std::size_t window) : from(n), to(n), permutation(n), count(1) {
    auto const exec = bench::policy();
    array<std::uint64_t> keys(n);
    thrust::tabulate(exec, keys.begin(), keys.end(), make_key{window});
    thrust::tabulate(exec, from.begin(), from.end(), make_element<Bytes>{});
    thrust::sequence(exec, permutation.begin(), permutation.end());
    thrust::stable_sort_by_key(exec, keys.begin(), keys.end(), permutation.begin());
    count[0] = static_cast<ds_index>(n);
  }
  ds::request_order order() const { return {raw(permutation), {raw(count), from.size()}}; }

  bool right(bool scattered) {
    auto const exec = bench::policy();
    return thrust::transform_reduce(exec, thrust::counting_iterator<ds_index>(0),
                                    thrust::counting_iterator<ds_index>(count[0]),
                                    is_wrong<Bytes>{raw(to), raw(permutation), scattered}, 0,
                                    thrust::plus<int>{}) == 0;
  }

  array<element<Bytes>> from, to;
  array<ds_index> permutation, count;
};

template <int Bytes>
void add_cells(std::size_t n, std::string const& order, std::size_t window) {
  using arrays = moving<Bytes>;
  auto const current = std::make_shared<std::unique_ptr<arrays>>();
  auto const add = [&](char const* way, bool compare, bool scattered, auto const& call) {
    std::string const name = std::to_string(Bytes) + " bytes/" + order + "/" + way;
    bool const last = std::string(way) == "scatter";
    bench::add_cell(name + "/n:" + std::to_string(n), [=](auto& state) {
      if (!*current) *current = std::make_unique<arrays>(n, window);
      arrays& m = **current;
      call(m);
      bool const good = bench::check(state, !compare || m.right(scattered));
      if (good) bench::measure(state, n, [&] { call(m); });
      if (last) current->reset();
    });
  };
  add("copy", false, false, [](arrays& m) {
    bench::check_cuda(cudaMemcpyAsync(raw(m.to), raw(m.from), m.from.size() * Bytes,
                                      cudaMemcpyDeviceToDevice, bench::stream()));
  });
  add("thrust", true, false, [](arrays& m) {
    thrust::gather(bench::policy(), m.permutation.begin(), m.permutation.end(), m.from.begin(),
                   m.to.begin());
  });
  add("gather", true, false, [](arrays& m) {
    ds::gather(bench::policy(), m.order(), ds::moved{raw(m.from), raw(m.to)});
  });
  add("scatter", true, true, [](arrays& m) {
    ds::scatter(bench::policy(), m.order(), ds::moved{raw(m.from), raw(m.to)});
  });
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run(argc, argv, [&](bool quick) {
    using bench::operator""_mi;
    for (std::size_t const n : quick ? std::vector{1_mi} : std::vector{1_mi, 8_mi, 16_mi}) {
      for (std::string const& order : {std::string("windows"), std::string("random")}) {
        std::size_t const window = order == "windows" ? std::size_t{1} << 17 : n;
        add_cells<16>(n, order, window);
        add_cells<32>(n, order, window);
        add_cells<48>(n, order, window);
        add_cells<80>(n, order, window);
        add_cells<128>(n, order, window);
      }
    }
  });
}
