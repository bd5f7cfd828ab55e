// SPDX-License-Identifier: Apache-2.0
// The program built for other numbers and other records (DEFERRED_SHADE_BUILD_ACCURACIES): the same
// random numbers make the same paths, except for those that rounding sends elsewhere.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "process.hpp"

using namespace path_tracer_test;

namespace {

constexpr int width = 48, height = 32;

struct picture {
  std::string precision, storage;
  std::vector<float> values;
  std::uint64_t discarded;
};

picture render_with(std::string const& program, std::string const& scene) {
  temporary_folder const folder;
  outcome const run = run_program({program, scene, "-o", folder / "a.pfm", "--report",
                                   folder / "r.json", "--quiet", "--width", std::to_string(width),
                                   "--height", std::to_string(height), "--spp", "8"});
  CAPTURE(program, run.err);
  REQUIRE(run.exit_code == 0);
  auto const report = nlohmann::json::parse(read_bytes(folder / "r.json"));
  std::string const bytes = read_bytes(folder / "a.pfm");
  picture result{report["settings"]["precision"], report["settings"]["storage"],
                 std::vector<float>(3 * width * height),
                 report["schedules"][0]["discarded_samples"]};
  std::size_t const size = result.values.size() * sizeof(float);
  REQUIRE(bytes.size() > size);
  std::memcpy(result.values.data(), bytes.data() + bytes.size() - size, size);
  return result;
}

std::string const gallery = PATH_TRACER_SCENES "/gallery.gltf";

}  // namespace

TEST_CASE("a report says in which numbers a picture was made", "[builds]") {
  picture const p = render_with(PATH_TRACER_EXECUTABLE, gallery);
  CHECK(p.precision == "float");
  CHECK(p.storage == "full");
  CHECK(p.discarded == 0);
}

#ifdef PATH_TRACER_ACCURACIES

namespace {

struct difference {
  double median, mean;  ///< of pixels, relative to `b` and a hundredth of its mean; of the picture
  bool identical;
};

difference compare(std::vector<float> const& a, std::vector<float> const& b) {
  REQUIRE(a.size() == b.size());
  double sum_a = 0, sum_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(std::isfinite(a[i]));
    sum_a += a[i];
    sum_b += b[i];
  }
  double const least = 0.01 * sum_b / static_cast<double>(b.size());
  std::vector<double> each;
  for (std::size_t i = 0; i < a.size(); ++i)
    each.push_back(std::fabs(double{a[i]} - double{b[i]}) / (double{b[i]} + least));
  std::nth_element(each.begin(), each.begin() + width * height * 3 / 2, each.end());
  return {each[each.size() / 2], std::fabs(sum_a / sum_b - 1), a == b};
}

}  // namespace

TEST_CASE("double, fast and compact builds make the picture of the usual one", "[builds]") {
  std::string const scene = GENERATE(
      PATH_TRACER_SCENES "/box.gltf", PATH_TRACER_SCENES "/gallery.gltf",
      PATH_TRACER_SCENES "/effects/medium.gltf", PATH_TRACER_SCENES "/effects/environment.gltf");
  std::string const usual = PATH_TRACER_EXECUTABLE;
  picture const p = render_with(usual, scene);
  struct {
    char const *name, *precision, *storage;
    double median;
  } const builds[] = {{"_double", "double", "full", 3e-5},
                      {"_fast", "fast", "full", 3e-5},
                      {"_compact", "float", "compact", 1e-2}};
  for (auto const& build : builds) {
    CAPTURE(scene, build.name);
    picture const q = render_with(usual + build.name, scene);
    CHECK(q.precision == build.precision);
    CHECK(q.storage == build.storage);
    CHECK(q.discarded == 0);
    difference const d = compare(q.values, p.values);
    CAPTURE(d.median, d.mean);
    CHECK_FALSE(d.identical);
    CHECK(d.median < build.median);
    CHECK(d.mean < 0.02);
  }
}

#endif
