// SPDX-License-Identifier: Apache-2.0
#include "catch.hpp"
#include "path_tracer/load.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

TEST_CASE("a scene far away keeps its digits") {
  gltf_fixture f;
  f.at("/accessors/0/min") = {0, 0, 0};
  f.at("/accessors/0/max") = {1, 1, 0};
  f.at("/nodes/1/translation") = {0.3, 0.2, 0.1};
  scene const here = load(f);
  CHECK(here.origin == vec3(0));
  for (double const away : {1e3, 1e5, 1e7}) {
    CAPTURE(away);
    f.root["nodes"].push_back(
        {{"children", {0, 1, 2}}, {"translation", {away, -away / 2, away / 4}}});
    f.at("/scenes/0/nodes") = {f.root["nodes"].size() - 1};
    scene const there = load(f);
    REQUIRE(there.triangles.size() == 1);
    vec3 const from = here.view.position, to = there.view.position;
    for (int k = 0; k < 3; ++k)
      CHECK(glm::length((there.triangles[0].position[k] - to) -
                        (here.triangles[0].position[k] - from)) < 2e-6f);
    CHECK(glm::length((there.lights[0].position - to) - (here.lights[0].position - from)) < 2e-6f);
    // Patterns in space stay where the file has them.
    CHECK(glm::length(there.triangles[0].position[0] + there.origin -
                      vec3(glm::dvec3(away + 0.3, -away / 2 + 0.2, away / 4 + 0.1))) < 1e-6 * away);
  }
}
