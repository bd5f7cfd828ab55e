// SPDX-License-Identifier: Apache-2.0
// Covers detail/ids.hpp.
#include <deferred_shade/types.hpp>

#include <cstdint>

#include "catch.hpp"

namespace ds = deferred_shade;

TEST_CASE("shader_of maps every id outside the table to its size", "[types]") {
  std::int8_t const bytes[] = {0, 1, 2, 3, -1, -128, 127};
  ds::shader_id const expected[] = {0, 1, 2, 3, 3, 3, 3};
  for (ds::request_index i = 0; i < 7; ++i) CHECK(ds::shader_of(&bytes[0], i, 3) == expected[i]);

  std::uint32_t const words[] = {0, 2, 3, 0xffffffffU, 0x80000000U};
  ds::shader_id const expected_words[] = {0, 2, 3, 3, 3};
  for (ds::request_index i = 0; i < 5; ++i)
    CHECK(ds::shader_of(&words[0], i, 3) == expected_words[i]);
}

TEST_CASE("an enumeration is an id", "[types]") {
  enum class material : std::uint8_t { matte, glass, none = 255 };
  material const ids[] = {material::glass, material::matte, material::none};
  CHECK(ds::shader_of(&ids[0], 0, 2) == 1);
  CHECK(ds::shader_of(&ids[0], 1, 2) == 0);
  CHECK(ds::shader_of(&ids[0], 2, 2) == 2);
}

TEST_CASE("a device_count is deduced from a pointer and a maximum", "[types]") {
  std::uint16_t const count = 7;
  ds::device_count const n{&count, 100};
  STATIC_REQUIRE(std::is_same_v<decltype(n), ds::device_count<std::uint16_t> const>);
  CHECK(*n.pointer == 7);
  CHECK(n.maximum == 100);
}
