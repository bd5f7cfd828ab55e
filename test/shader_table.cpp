// SPDX-License-Identifier: Apache-2.0
// Covers detail/shader_list.hpp.
#include <deferred_shade/shader_table.hpp>

#include <cstdint>
#include <utility>
#include <vector>

#include "catch.hpp"

namespace ds = deferred_shade;

namespace {

struct noting {
  std::uint32_t id;
  std::vector<std::pair<std::uint32_t, std::uint32_t>>* runs;
  void operator()(ds::request_index i) const { runs->emplace_back(id, i); }
};

template <std::uint32_t... Ids>
auto table_of(std::vector<std::pair<std::uint32_t, std::uint32_t>>& runs,
              std::integer_sequence<std::uint32_t, Ids...>) {
  return ds::shader_table{noting{Ids, &runs}...};
}

template <std::uint32_t Size>
void check_table() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
  auto const table = table_of(runs, std::make_integer_sequence<std::uint32_t, Size>());
  STATIC_REQUIRE(decltype(table)::size() == Size);
  for (std::uint32_t id = 0; id < Size; ++id) {
    table.run(id, 1000 + id);
    REQUIRE(runs.size() == id + 1);
    CHECK(runs.back() == std::pair(id, 1000 + id));
  }
  table.run(Size, 1);
  table.run(0xffffffffU, 1);
  CHECK(runs.size() == Size);
}

}  // namespace

TEST_CASE("run calls the shader at the position of the id", "[shader_table]") {
  check_table<1>();
  check_table<2>();
  check_table<32>();
  check_table<33>();
  check_table<300>();
}

TEST_CASE("for_each passes every shader with its id", "[shader_table]") {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
  ds::shader_table const table{noting{7, &runs}, noting{8, &runs}};
  std::vector<std::uint32_t> seen;
  table.for_each([&](auto id, noting const& shader) {
    STATIC_REQUIRE(decltype(id)::value < 2);
    seen.push_back(id);
    CHECK(shader.id == 7 + id);
  });
  CHECK(seen == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("a table holds lambdas and one shader twice", "[shader_table]") {
  int calls = 0;
  auto const count = [&calls](ds::request_index) { ++calls; };
  ds::shader_table const table{count, count};
  table.run(0, 0);
  table.run(1, 0);
  CHECK(calls == 2);
}

TEST_CASE("a shader may be over-aligned, empty, or without a default", "[shader_table]") {
  struct alignas(64) aligned {
    std::uintptr_t* address;
    void operator()(ds::request_index) const { *address = reinterpret_cast<std::uintptr_t>(this); }
  };
  struct empty {
    void operator()(ds::request_index) const {}
  };
  struct no_default {
    explicit no_default(int* p) : calls(p) {}
    int* calls;
    void operator()(ds::request_index) const { ++*calls; }
  };
  std::uintptr_t address = 1;
  int calls = 0;
  ds::shader_table const table{empty{}, aligned{&address}, empty{}, no_default{&calls}, empty{}};
  for (ds::shader_id id = 0; id < 6; ++id) table.run(id, 0);
  CHECK(address % 64 == 0);
  CHECK(calls == 1);
}

namespace {

/// Fails to compile if it is asked for the shader of a left-out id.
struct taking_noting {
  std::vector<std::uint32_t>* seen;
  void operator()(noting const& shader) const { seen->push_back(shader.id); }
};

}  // namespace

TEST_CASE("only keeps ids, and makes no code for the shaders that it leaves out",
          "[shader_table]") {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
  auto const all = table_of(runs, std::make_integer_sequence<std::uint32_t, 40>());
  auto const some = all.only<39, 3, 3, 17>();
  using table = decltype(some);
  STATIC_REQUIRE(table::size() == 40);
  STATIC_REQUIRE(table::first_id() == 3);
  STATIC_REQUIRE((table::has<3> && table::has<17> && table::has<39>));
  STATIC_REQUIRE((!table::has<0> && !table::has<4> && !table::has<38>));
  STATIC_REQUIRE(sizeof(all.only<3>()) < sizeof(all));

  std::vector<std::uint32_t> seen;
  for (std::uint32_t id = 0; id < 42; ++id) {
    some.visit(id, taking_noting{&seen});
    some.run(id, 7);
  }
  CHECK(seen == std::vector<std::uint32_t>{3, 17, 39});
  using run = std::pair<std::uint32_t, std::uint32_t>;
  CHECK(runs == std::vector<run>{{3, 7}, {17, 7}, {39, 7}});

  seen.clear();
  some.for_each([&](auto id, noting const& shader) {
    CHECK(id == shader.id);
    seen.push_back(shader.id);
  });
  CHECK(seen == std::vector<std::uint32_t>{3, 17, 39});
  STATIC_REQUIRE(decltype(some.only<17>())::first_id() == 17);
}

namespace {

template <class Table, std::uint32_t... Ids>
auto first_of(Table const& table, std::integer_sequence<std::uint32_t, Ids...>) {
  return table.template only<Ids...>();
}

}  // namespace

TEST_CASE("only takes more than 256 ids", "[shader_table]") {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
  auto const all = table_of(runs, std::make_integer_sequence<std::uint32_t, 320>());
  auto const some = first_of(all, std::make_integer_sequence<std::uint32_t, 300>());
  some.run(299, 1);
  some.run(300, 2);
  CHECK(runs == std::vector<std::pair<std::uint32_t, std::uint32_t>>{{299, 1}});
}

TEST_CASE("a table says which shaders may occur", "[shader_table]") {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
  auto const all = table_of(runs, std::make_integer_sequence<std::uint32_t, 70>());
  CHECK(all.expected().all());
  auto const some = all.only<1, 2, 69>();
  CHECK(some.expected() == (std::bitset<70>().set(1).set(2).set(69)));
  auto const fewer = some.expecting(std::bitset<70>().set(2).set(3).set(69));
  CHECK(fewer.expected() == (std::bitset<70>().set(2).set(69)));
  CHECK(fewer.only<69, 1>().expected() == (std::bitset<70>().set(69)));
  CHECK(some.expected().count() == 3);
  CHECK(all.expecting({}).expected().none());
}
