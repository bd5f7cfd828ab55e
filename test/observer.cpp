// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/observer.hpp>

#include <examples/largest_first_then_dispatch.hpp>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "support/every_schedule.hpp"
#include "support/ledger.hpp"
#include "support/schedule_properties.hpp"

namespace ds = deferred_shade;

namespace {

/// What an observer was told, phases in brackets: "group{}dispatch{shader 1 of 3{}}".
struct diary {
  std::string text;
  int open = 0;

  struct entry {
    diary* book;
    explicit entry(diary* d) : book(d) { ++book->open; }
    entry(entry const&) = delete;
    ~entry() {
      book->text += '}';
      --book->open;
    }
  };
  auto observer() {
    return [this](ds::phase const& p) {
      text += p.name;
      if (p.shader) text += ' ' + std::to_string(*p.shader);
      if (p.requests) text += " of " + std::to_string(*p.requests);
      text += '{';
      return entry(this);
    };
  }
};

struct nothing {
  void operator()(ds::request_index) const {}
};

// Shader 1 does not occur, and neither do ids outside the table.
std::vector<std::uint8_t> const some_ids{2, 0, 255, 2, 2, 0, 4};

template <class Schedule, class Policy, class Table>
std::string told(Policy const& exec, std::vector<std::uint8_t> const& ids, Table const& table) {
  diary book;
  ds::workspace scratch{exec};
  ds::observed seen{scratch, book.observer()};
  ds::shade(exec, Schedule{}, ids.size(), ids.data(), table, seen);
  CHECK(book.open == 0);
  return book.text;
}

using implicit = ds::implicit_serialization;

}  // namespace

TEMPLATE_LIST_TEST_CASE("an observer is told the phases of every schedule, in order", "[observed]",
                        test::host_backends) {
  auto const exec = TestType::policy();
  auto const three = ds::shader_table{nothing{}, nothing{}, nothing{}};
  std::string const masked = "dispatch{shader 0{}shader 1{}shader 2{}}";
  std::string const segments = "group{}dispatch{shader 0 of 2{}shader 2 of 3{}}";
  CHECK(told<implicit>(exec, some_ids, three) == "dispatch{}");
  CHECK(told<ds::explicit_serialization>(exec, some_ids, three) == masked);
  CHECK(told<ds::compact_then_dispatch<>>(exec, some_ids, three) == segments);
  CHECK(told<ds::sort_then_dispatch<>>(exec, some_ids, three) == segments);
  CHECK(told<ds::bucket_then_dispatch<>>(exec, some_ids, three) == segments);
  CHECK(told<ds::compact_then_dispatch<implicit>>(exec, some_ids, three) == "group{}dispatch{}");
  CHECK(told<ds::sort_then_dispatch<implicit>>(exec, some_ids, three) == "group{}dispatch{}");
  CHECK(told<ds::bucket_then_dispatch<implicit>>(exec, some_ids, three) == "group{}dispatch{}");
  CHECK(told<ds::local_sort_then_dispatch<>>(exec, some_ids, three) == "dispatch{}");
  CHECK(told<ds::local_sort_then_dispatch<ds::bitonic>>(exec, some_ids, three) == "dispatch{}");
  CHECK(told<ds::window_sort_then_dispatch>(exec, some_ids, three) == "dispatch{}");
  CHECK(told<largest_first_then_dispatch>(exec, some_ids, three) == "group{}");
}

TEST_CASE("shaders that are not expected or not in the table are not told of", "[observed]") {
  auto const three = ds::shader_table{nothing{}, nothing{}, nothing{}};
  auto const expecting = three.expecting(std::bitset<3>().set(1).set(2));
  CHECK(told<ds::explicit_serialization>(thrust::cpp::par, some_ids, expecting) ==
        "dispatch{shader 1{}shader 2{}}");
  CHECK(told<ds::bucket_then_dispatch<>>(thrust::cpp::par, some_ids, three.only<1, 2>()) ==
        "group{}dispatch{shader 2 of 3{}}");
}

TEST_CASE("an empty batch has no phases, and one that no shader is named in has no shader",
          "[observed]") {
  auto const one = ds::shader_table{nothing{}};
  test::for_each_schedule(
      [&](auto schedule) { CHECK(told<decltype(schedule)>(thrust::cpp::par, {}, one).empty()); });
  CHECK(told<ds::bucket_then_dispatch<>>(thrust::cpp::par, {7, 9}, one) == "group{}dispatch{}");
}

TEST_CASE("phases end where an exception leaves them", "[observed]") {
  auto const throwing = [](ds::request_index i) {
    if (i == 4) throw std::runtime_error("no");
  };
  ds::shader_table const table{throwing, throwing, throwing};
  test::for_each_schedule([&](auto const& schedule) {
    diary book;
    ds::workspace scratch{thrust::cpp::par};
    ds::observed seen{scratch, book.observer()};
    CHECK_THROWS_AS(
        ds::shade(thrust::cpp::par, schedule, some_ids.size(), some_ids.data(), table, seen),
        std::runtime_error);
    CHECK(book.open == 0);
    CHECK(book.text.back() == '}');
  });
  test::ledger books;
  books.limit = 0;
  diary book;
  ds::workspace scratch{test::ledger_allocator<std::byte>(books)};
  ds::observed seen{scratch, book.observer()};
  CHECK_THROWS_AS(ds::shade(thrust::cpp::par, ds::bucket_then_dispatch<>{}, some_ids.size(),
                            some_ids.data(), table, seen),
                  std::bad_alloc);
  CHECK(book.text == "group{}");
}

TEST_CASE("threads with a workspace each have observers each", "[observed]") {
  std::string texts[4];
  std::vector<std::thread> threads;
  for (std::string& text : texts) {
    threads.emplace_back([&text] {
      diary book;
      ds::workspace scratch{thrust::cpp::par};
      ds::observed seen{scratch, book.observer()};
      for (int k = 0; k < 100; ++k)
        ds::shade(thrust::cpp::par, ds::bucket_then_dispatch<>{}, some_ids.size(), some_ids.data(),
                  ds::shader_table{nothing{}, nothing{}, nothing{}}, seen);
      text = book.text;
    });
  }
  for (std::thread& t : threads) t.join();
  CHECK(texts[0].size() ==
        100 * std::string("group{}dispatch{shader 0 of 2{}shader 2 of 3{}}").size());
  for (std::string const& text : texts) CHECK(text == texts[0]);
}

TEMPLATE_LIST_TEST_CASE("an observed batch runs as one that is not", "[observed]",
                        test::host_backends) {
  test::for_each_schedule([](auto const& schedule) {
    auto const observed = [&](auto const& exec, auto n, auto ids, auto const& table,
                              auto& scratch) {
      diary book;
      ds::observed seen{scratch, book.observer()};
      ds::shade(exec, schedule, n, ids, table, seen);
      ds::shade(exec, implicit{}, ds::device_count{&n, n}, ids, ds::shader_table{nothing{}}, seen);
      CHECK(book.open == 0);
    };
    std::uint32_t const n = TestType::many_blocks;
    auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 5, test::run_seed());
    ds::workspace scratch{TestType::policy()};
    test::check_against_loop<TestType, 5>(observed, n, ids.data(), scratch);
  });
}
