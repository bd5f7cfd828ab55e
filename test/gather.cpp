// SPDX-License-Identifier: Apache-2.0
// Covers detail/moved.hpp, detail/cpu/gather.hpp and detail/cuda/gather.hpp.
#include <deferred_shade/gather.hpp>
#include <deferred_shade/grouping.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"

namespace {

namespace ds = deferred_shade;

/// An element of any size and alignment.
template <std::size_t Size, std::size_t Alignment>
struct alignas(Alignment) blob {
  std::array<std::uint8_t, Size> bytes;
  bool operator==(blob const& other) const { return bytes == other.bytes; }
};

/// A vector type of the old kind: its copy constructor only copies.
struct old_vector {
  float x = 0, y = 0, z = 0;
  old_vector() = default;
  DEFERRED_SHADE_HOST_DEVICE old_vector(old_vector const& other)
      : x(other.x), y(other.y), z(other.z) {}
  DEFERRED_SHADE_HOST_DEVICE old_vector& operator=(old_vector const& other) {
    x = other.x, y = other.y, z = other.z;
    return *this;
  }
  bool operator==(old_vector const& other) const {
    return x == other.x && y == other.y && z == other.z;
  }
};

template <class T>
void fill(T& element, std::mt19937& engine) {
  for (std::uint8_t& byte : element.bytes) byte = static_cast<std::uint8_t>(engine());
}
void fill(std::uint32_t& element, std::mt19937& engine) {
  element = static_cast<std::uint32_t>(engine());
}
void fill(old_vector& element, std::mt19937& engine) {
  element.x = static_cast<float>(engine() % 1000);
  element.z = static_cast<float>(engine() % 1000);
}

template <class T>
std::vector<T> random_elements(std::size_t n, std::mt19937& engine) {
  std::vector<T> elements(n);
  for (T& element : elements) fill(element, engine);
  return elements;
}

/// The first `count` requests of a random order of `n`.
template <class Backend>
struct random_order {
  random_order(std::uint32_t n, std::uint32_t count, std::mt19937& engine) : maximum(n) {
    std::vector<ds::request_index> order(n);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), engine);
    permutation = test::on<Backend>(order);
    size = test::on<Backend>(std::vector<ds::request_index>{count});
  }
  operator ds::request_order() const { return {permutation.data(), {size.data(), maximum}}; }

  std::size_t maximum;
  typename Backend::template vector<ds::request_index> permutation, size;
};

template <class T, class A, class B>
bool equal(A const& a, B const& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// Moves an array of T there and back, beside one of words, and compares with plain loops. `skip`:
/// the elements by which the arrays begin later than their memory.
template <class Backend, class T>
void check_moves(std::uint32_t n, std::uint32_t count, std::size_t skip) {
  std::uint32_t const seed = test::run_seed() + n + count;
  CAPTURE(n, count, skip, seed, sizeof(T), alignof(T));
  std::mt19937 engine(seed);
  auto const from = random_elements<T>(n + skip, engine);
  auto const words = random_elements<std::uint32_t>(n + skip, engine);
  auto const old = random_elements<T>(n + skip, engine);
  auto const old_words = random_elements<std::uint32_t>(n + skip, engine);
  random_order<Backend> const order(n, count, engine);
  auto const exec = Backend::policy();

  auto const source = test::on<Backend>(from);
  auto const source_words = test::on<Backend>(words);
  auto to = test::on<Backend>(old);
  auto to_words = test::on<Backend>(old_words);
  ds::gather(exec, order, ds::moved{source.data() + skip, to.data() + skip},
             ds::moved{source_words.data() + skip, to_words.data() + skip});
  Backend::wait();
  auto expected = old;
  auto expected_words = old_words;
  for (std::size_t p = 0; p < count; ++p) {
    expected[skip + p] = from[skip + order.permutation[p]];
    expected_words[skip + p] = words[skip + order.permutation[p]];
  }
  CHECK(equal<T>(to, expected));
  CHECK(equal<T>(to_words, expected_words));

  auto back = test::on<Backend>(old);
  ds::scatter(exec, order, ds::moved{to.data() + skip, back.data() + skip});
  Backend::wait();
  auto expected_back = old;
  for (std::size_t p = 0; p < count; ++p) {
    expected_back[skip + order.permutation[p]] = from[skip + order.permutation[p]];
  }
  CHECK(equal<T>(back, expected_back));
}

template <class Backend, class T>
void check_sizes() {
  for (std::uint32_t const n : test::edge_sizes<Backend>()) {
    check_moves<Backend, T>(n, n, 0);
    check_moves<Backend, T>(n, n / 3, 1);
  }
}

}  // namespace

template <>
inline constexpr bool deferred_shade::is_copied_by_bytes<old_vector> = true;

TEMPLATE_LIST_TEST_CASE("gather and scatter move elements of any size", "[gather]",
                        test::backends) {
  check_sizes<TestType, std::uint32_t>();
  check_sizes<TestType, blob<1, 1>>();
  check_sizes<TestType, blob<3, 1>>();
  check_sizes<TestType, blob<6, 2>>();
  check_sizes<TestType, blob<32, 16>>();
  check_sizes<TestType, blob<48, 4>>();
  check_sizes<TestType, blob<80, 4>>();
  check_sizes<TestType, blob<80, 16>>();
  check_sizes<TestType, blob<100, 4>>();
  check_sizes<TestType, blob<128, 64>>();
  check_sizes<TestType, blob<513, 1>>();
  check_sizes<TestType, old_vector>();
}

TEMPLATE_LIST_TEST_CASE("gather brings the requests of a batch into the order of their shaders",
                        "[gather]", test::backends) {
  using path = blob<80, 16>;
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  std::uint32_t const n = TestType::many_blocks;
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 6, seed);
  auto const paths = random_elements<path>(n, engine);
  auto const there = test::on<TestType>(paths);
  auto const named = test::on<TestType>(ids);
  auto next = test::on<TestType>(std::vector<path>(n));
  auto next_ids = test::on<TestType>(std::vector<std::uint8_t>(n, 77));
  auto const groups = ds::group(exec, n, named.data(), 6, scratch);
  ds::gather(exec, groups.live(), ds::moved{there.data(), next.data()},
             ds::moved{named.data(), next_ids.data()});
  TestType::wait();

  std::vector<path> expected;
  std::vector<std::uint8_t> expected_ids;
  for (std::uint8_t k = 0; k < 6; ++k) {
    for (std::uint32_t i = 0; i < n; ++i) {
      if (ids[i] != k) continue;
      expected.push_back(paths[i]);
      expected_ids.push_back(k);
    }
  }
  std::size_t const live = expected.size();
  CHECK(TestType::read(groups.live().n.pointer, 1)[0] == live);
  expected.resize(n);
  expected_ids.resize(n, 77);
  CHECK(equal<path>(next, expected));
  CHECK(equal<std::uint8_t>(next_ids, expected_ids));
}

TEMPLATE_LIST_TEST_CASE("gather says what is wrong with its arguments", "[gather]",
                        test::backends) {
  auto const exec = TestType::policy();
  auto array = test::on<TestType>(std::vector<int>(5));
  auto other = test::on<TestType>(std::vector<int>(5));
  int* const nowhere = nullptr;
  std::mt19937 engine(1);
  random_order<TestType> const order(5, 5, engine);
  ds::moved const right{array.data(), other.data()};
  CHECK_THROWS_AS(ds::gather(exec, order, right, ds::moved{array.data(), nowhere}),
                  std::invalid_argument);
  CHECK_THROWS_AS(ds::gather(exec, order, ds::moved{nowhere, other.data()}), std::invalid_argument);
  CHECK_THROWS_WITH(ds::scatter(exec, order, ds::moved{array.data(), array.data()}),
                    "deferred_shade::scatter: an array must not be moved to itself; keep it twice");
  ds::request_order wrong = order;
  wrong.permutation = nullptr;
  CHECK_THROWS_AS(ds::gather(exec, wrong, right), std::invalid_argument);
  wrong = order;
  wrong.n.pointer = nullptr;
  CHECK_THROWS_AS(ds::gather(exec, wrong, right), std::invalid_argument);
  wrong.n = {order.size.data(), 0};
  wrong.permutation = nullptr;
  if constexpr (std::is_base_of_v<test::on_host, TestType>) {
    wrong.n.maximum = 4;
    wrong.permutation = order.permutation.data();
    CHECK_THROWS_AS(ds::gather(exec, wrong, right), std::length_error);
  } else {
    CHECK_NOTHROW(ds::gather(exec, wrong, ds::moved{nowhere, nowhere}));
  }
}
