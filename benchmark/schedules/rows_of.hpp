// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>

#include "../rows.hpp"

namespace bench {

/// The two kinds of shaders: those that load and store for themselves, and those that leave it to
/// the library.
struct index_shaders {
  static constexpr char const* name = "index";
  template <class Set>
  static auto table(view const& v) {
    return Set::index(v.requests, v.results);
  }
};
struct record_shaders {
  static constexpr char const* name = "record";
  template <class Set>
  static auto table(view const& v) {
    return Set::record(v.requests, v.results);
  }
};

template <class Table>
struct switch_on_id {
  Table table;
  std::uint8_t const* ids;
  DEFERRED_SHADE_HOST_DEVICE void operator()(request_index i) const { table.run(ids[i], i); }
};

template <class Shader>
struct shade_from {
  Shader shader;
  request_index first;
  DEFERRED_SHADE_HOST_DEVICE void operator()(request_index i) const { shader(first + i); }
};

template <class Shader>
struct shade_permuted {
  Shader shader;
  request_index const* permutation;
  DEFERRED_SHADE_HOST_DEVICE void operator()(request_index i) const { shader(permutation[i]); }
};

/// The ways to run the shaders of `Set`, of kind `Kind`.
template <class Set, class Kind>
struct ways {
  template <class Schedule>
  static void schedule(view const& v) {
    ds::shade(policy(), Schedule{}, v.n, v.ids, Kind::template table<Set>(v), scratch());
  }

  /// An oracle: one launch per shader, with counts that the host knows.
  static void launches(view const& v) {
    Kind::template table<Set>(v).for_each([&](auto id, auto const& shader) {
      request_index const first = v.offsets[id];
      for_each_request(v.offsets[id + 1] - first,
                       shade_from<std::decay_t<decltype(shader)>>{shader, first});
    });
  }

  /// A launch with a switch, in which every shader loads and stores for itself: an oracle where the
  /// requests lie sorted, and else a control.
  static void one_launch(view const& v) {
    auto const table = Kind::template table<Set>(v);
    for_each_request(v.n, switch_on_id<std::decay_t<decltype(table)>>{table, v.ids});
  }

  /// A control: bucket_then_dispatch<explicit_serialization> if the host knew the counts.
  static void known_counts(view const& v) {
    auto const group =
        ds::group_by_bucket<Set::size>(policy(), static_cast<request_index>(v.n), v.ids, scratch());
    Kind::template table<Set>(v).for_each([&](auto id, auto const& shader) {
      request_index const first = v.offsets[id];
      for_each_request(v.offsets[id + 1] - first, shade_permuted<std::decay_t<decltype(shader)>>{
                                                      shader, group.permutation + first});
    });
  }

  static void plain_loop(view const& v) {
    auto const table = Kind::template table<Set>(v);
    for (std::size_t i = 0; i < v.n; ++i) table.run(v.ids[i], static_cast<request_index>(i));
  }

  static void add_to(std::vector<row>& rows) {
    using namespace ds;
    auto const add = [&](std::string const& name, void (*shade)(view const&), bool sorted = false) {
      rows.push_back({Kind::name, name, sorted, shade});
    };
    add("oracle-launches", launches, true);
    add("oracle-switch", one_launch, true);
    for_each_schedule(
        [&](char const* name, auto const& s) { add(name, schedule<std::decay_t<decltype(s)>>); });
    if (on_cuda) {  // on a CPU, the host always knows the counts, and implicit is this switch
      add("known-counts", known_counts);
      add("switch", one_launch);
    }
  }
};

template <class Set>
row_list rows_of() {
  row_list list{Set::size, {}, ways<Set, index_shaders>::plain_loop};
  ways<Set, index_shaders>::add_to(list.rows);
  ways<Set, record_shaders>::add_to(list.rows);
  return list;
}

}  // namespace bench
