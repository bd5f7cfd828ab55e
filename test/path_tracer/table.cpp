// SPDX-License-Identifier: Apache-2.0
// The table that compares schedules, and what it says in short.
#include "app/table.hpp"

#include <algorithm>
#include <sstream>

#include "catch.hpp"

using namespace path_tracer;

namespace {

run example(std::string const& schedule, double group_ms, double shading_ms, double seconds) {
  run r{schedule, {}};
  r.result.seconds = seconds;
  r.result.bounces = {{100, group_ms / 2, 0, shading_ms / 4, 0.98, {}, {}},
                      {50, group_ms / 2, 0, 3 * shading_ms / 4, 0.56, {}, {}}};
  return r;
}

std::vector<std::string> lines(std::string const& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

std::string row_of(std::string const& schedule, std::string const& text) {
  for (std::string const& line : lines(text))
    if (line.rfind(schedule + " ", 0) == 0) return line;
  return "";
}

}  // namespace

TEST_CASE("the table sums over bounces and compares with the switch", "[table]") {
  std::string const text =
      table({example("sort", 3, 20, 4), example("implicit", 0, 40, 5), example("local", 1, 50, 2)});
  CAPTURE(text);
  CHECK(lines(text).size() == 6);
  CHECK(text.rfind("times: as fast as the switch (implicit). *: the fastest.\n", 0) == 0);
  CHECK(row_of("sort", text) == "sort         3.0    20.0   2.00x*   4.000   1.25x   98  56");
  CHECK(row_of("implicit", text) == "implicit     0.0    40.0   1.00x    5.000   1.00x   98  56");
  CHECK(row_of("local", text) == "local        1.0    50.0   0.80x    2.000   2.50x*  98  56");
}

TEST_CASE("without the switch, the first schedule is what others are compared with", "[table]") {
  std::string const text = table({example("sort", 3, 20, 4), example("local", 1, 10, 8)});
  CAPTURE(text);
  CHECK(text.find("times: as fast as sort; the switch (implicit) was not rendered.") == 0);
  CHECK(row_of("sort", text).find("1.00x ") != std::string::npos);
  CHECK(row_of("local", text).find("2.00x*") != std::string::npos);
  CHECK(row_of("local", text).find("0.50x ") != std::string::npos);
  CHECK(in_short({example("sort", 3, 20, 4), example("local", 1, 10, 8)}) ==
        "Shading: local is 2.00 times as fast as sort.\n"
        "Whole picture: local is 0.50 times as fast (shading is 0 % of it).\n"
        "Grouping: 10 % of the shading by local.\n");
}

TEST_CASE("several renderings have medians and spreads", "[table]") {
  std::vector<run> runs;
  for (double const scale : {1.5, 0.9, 1.0}) {
    runs.push_back(example("implicit", 0, 100 * scale, 1));
    runs.push_back(example("local", 10 * scale, 50 * scale, 2 * scale));
  }
  auto const list = measurements_of(runs);
  REQUIRE(list.size() == 2);
  CHECK(list[1].schedule == "local");
  CHECK(list[1].renderings == 3);
  CHECK_THAT(list[1].group_ms.median, WithinRel(10.0, 1e-12));
  CHECK_THAT(list[1].shading_ms.median, WithinRel(50.0, 1e-12));
  CHECK_THAT(list[1].shading_ms.spread, WithinRel(0.6, 1e-12));
  CHECK(list[0].picture_s.spread == 0);
  std::string const text = table(runs);
  CAPTURE(text);
  CHECK(text.rfind("Medians of 3 renderings; ", 0) == 0);
  CHECK(row_of("local", text) ==
        "local       10.0    50.0   60%   2.00x*   2.000   60%   0.50x   98  56");
  CHECK(in_short(runs).find("\nNoise: pictures by one schedule differ by up to 60 % in time.\n") !=
        std::string::npos);
  // Of an even number, the median lies in the middle.
  runs.pop_back();
  runs.pop_back();
  CHECK_THAT(measurements_of(runs)[0].shading_ms.median, WithinRel(120.0, 1e-12));
  // One schedule alone has its spread, and nothing to be compared with.
  std::vector<run> const alone = {runs[0], runs[2]};
  CHECK(table(alone).find("times: ") == std::string::npos);
  CHECK(in_short(alone).empty());
}

TEST_CASE("no line of the table is longer than 80 characters", "[table]") {
  bool const repeated = GENERATE(false, true);
  bool const slow = GENERATE(false, true);
  std::vector<run> runs;
  for (std::string_view const name : schedules())
    for (int k = 0; k <= (repeated ? 1 : 0); ++k) {
      runs.push_back(example(std::string(name), 1, slow ? 123456.7 : 12.3, slow ? 1234.5 : 0.1));
      runs.back().result.bounces.resize(16);
    }
  std::string const text = table(runs) + in_short(runs);
  CAPTURE(text);
  for (std::string const& line : lines(text)) CHECK(line.size() <= 80);
  CHECK(std::count(text.begin(), text.end(), '*') ==
        3);  // one for shading and picture, one to explain
}

TEST_CASE("what the table comes to", "[table]") {
  CHECK(in_short({example("implicit", 0, 400, 2), example("sort", 50, 200, 1.9),
                  example("local", 10, 250, 1.6)}) ==
        "Shading: sort is 2.00 times as fast as the switch.\n"
        "Whole picture: local is 1.25 times as fast (shading is 20 % of it).\n"
        "Grouping: 25 % of the shading by sort.\n");
  // Where nothing is gained, it says so: the best of the others is below one.
  CHECK(in_short({example("implicit", 0, 400, 2), example("sort", 50, 500, 2.5)})
            .find("sort is 0.80 times as fast") != std::string::npos);
}
