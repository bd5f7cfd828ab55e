// SPDX-License-Identifier: Apache-2.0
// Six shaders that share most of their code, on a GPU, as they come:
//   copies   a table of six types, each with the shared code
//   shared   a table of shared_shaders
//   by-hand  one kernel with a switch inside of the shared code
// The first two by implicit_serialization and by a grouping. Ids are random.
#include <algorithm>
#include <memory>
#include <string>

#include "axes.hpp"
#include "batch.hpp"

namespace {

using bench::request;
using bench::result;
namespace ds = deferred_shade;

/// What differs: some operations of a material.
template <int Id>
DEFERRED_SHADE_HOST_DEVICE float lobe(float x) {
  return (0.2F + 0.05F * Id) * x * x + (Id % 2 == 0 ? std::fabs(x) : 1 - x);
}

DEFERRED_SHADE_HOST_DEVICE inline float lobe_of(ds::shader_id id, float x) {
  switch (id) {
    case 0:
      return lobe<0>(x);
    case 1:
      return lobe<1>(x);
    case 2:
      return lobe<2>(x);
    case 3:
      return lobe<3>(x);
    case 4:
      return lobe<4>(x);
    default:
      return lobe<5>(x);
  }
}

/// What is shared: some 500 instructions of light sampling, with the material's lobe in between.
template <class Lobe>
DEFERRED_SHADE_HOST_DEVICE result light(request const& r, Lobe const& lobe_at) {
  result out{{0, 0, 0}, 0};
  for (int l = 0; l < 8; ++l) {
    auto const number = static_cast<float>(l);
    float const toward = std::fabs(r.normal[2] + 0.1F * number * r.normal[0]);
    float const distance = 1 / (1 + toward * toward + number * r.u * r.u);
    float const shade = std::sin(9 * r.u + 5 * r.v + number) * std::sqrt(distance + 0.01F);
    float const value = lobe_at(toward * shade);
    out.radiance[0] += value * distance;
    out.radiance[1] += value * std::exp(-toward);
    out.radiance[2] += shade * distance;
    out.throughput += value;
  }
  return out;
}

template <int Id>
struct copy {
  request const* requests;
  result* results;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
    results[i] = light(requests[i], [](float x) { return lobe<Id>(x); });
  }
};
struct shared {
  request const* requests;
  result* results;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::shader_id id, ds::request_index i) const {
    results[i] = light(requests[i], [id](float x) { return lobe_of(id, x); });
  }
};
struct by_hand {
  std::uint8_t const* ids;
  shared shader;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { shader(ids[i], i); }
};

auto table_of_copies(bench::view const& v) {
  auto const [in, out] = std::pair(v.requests, v.results);
  return ds::shader_table{copy<0>{in, out}, copy<1>{in, out}, copy<2>{in, out},
                          copy<3>{in, out}, copy<4>{in, out}, copy<5>{in, out}};
}
auto table_of_shared(bench::view const& v) {
  return ds::shared_shaders<6>(shared{v.requests, v.results});
}

template <class Schedule, class Table>
void run(bench::view const& v, Table const& table) {
  ds::shade(bench::policy(), Schedule{}, v.n, v.ids, table, bench::scratch());
}

void plain_loop(bench::view const& v) {
  shared const shader{v.requests, v.results};
  for (std::size_t i = 0; i < v.n; ++i) shader(v.ids[i], static_cast<ds::request_index>(i));
}

}  // namespace

int main(int argc, char** argv) {
  std::shared_ptr<bench::batch> current;
  auto const add = [&](std::string const& way, std::size_t n, void (*shade)(bench::view const&)) {
    bench::add_cell("6 alike/" + way + "/n:" + std::to_string(n), [=, &current](auto& state) {
      if (!current || current->requests(false).n != n) {
        current = nullptr;
        current = std::make_shared<bench::batch>(n, 6, 1);
        auto const hand = [](bench::view const& v) {
          bench::for_each_request(v.n, by_hand{v.ids, {v.requests, v.results}});
        };
        if (!bench::check(state, current->take_reference(hand, plain_loop))) return;
      }
      if (!bench::check(state, current->agrees(shade, false))) return;
      bench::view const requests = current->requests(false);
      bench::measure(state, n, [&] { shade(requests); });
    });
  };
  return bench::run(argc, argv, [&](bool quick) {
    using bench::operator""_mi;
    using implicit = ds::implicit_serialization;
    using bucket = ds::bucket_then_dispatch<implicit>;
    for (std::size_t const n : quick ? std::vector{1_mi} : std::vector{1_mi, 8_mi}) {
      add("by-hand", n, [](bench::view const& v) {
        bench::for_each_request(v.n, by_hand{v.ids, {v.requests, v.results}});
      });
      add("copies+implicit", n, [](bench::view const& v) { run<implicit>(v, table_of_copies(v)); });
      add("shared+implicit", n, [](bench::view const& v) { run<implicit>(v, table_of_shared(v)); });
      add("copies+bucket", n, [](bench::view const& v) { run<bucket>(v, table_of_copies(v)); });
      add("shared+bucket", n, [](bench::view const& v) { run<bucket>(v, table_of_shared(v)); });
    }
  });
}
