// SPDX-License-Identifier: Apache-2.0
// The timeline of a rendering, and the file of it.
#include "app/trace.hpp"

#include <map>
#include <set>

#include "catch.hpp"
#include "effects/scene_effects.hpp"
#include "path_tracer/fixture.hpp"
#include "path_tracer/process.hpp"
#include "path_tracer/render_support.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

/// Spans of one thread, in nanoseconds, with the span that each lies in; -1: in none.
struct nested_span {
  json event;
  std::int64_t begin, end;
  int parent;
  std::string name() const { return event["name"]; }
};

/// Checks that the spans of a thread nest, the outer one first, and that none ends before it
/// begins.
std::vector<nested_span> nested(json const& events, int process, int thread) {
  std::vector<nested_span> spans;
  std::vector<int> open;
  for (json const& e : events) {
    if (e["ph"] != "X" || e["pid"] != process || e["tid"] != thread) continue;
    std::int64_t const begin = std::llround(1e3 * e["ts"].get<double>());
    std::int64_t const end = begin + std::llround(1e3 * e["dur"].get<double>());
    REQUIRE(begin >= 0);
    REQUIRE(end >= begin);
    while (!open.empty() && begin >= spans[static_cast<std::size_t>(open.back())].end)
      open.pop_back();
    int const parent = open.empty() ? -1 : open.back();
    if (parent >= 0) REQUIRE(end <= spans[static_cast<std::size_t>(parent)].end);
    open.push_back(static_cast<int>(spans.size()));
    spans.push_back({e, begin, end, parent});
  }
  return spans;
}

/// The time of the spans of a name in spans of another.
std::int64_t time_in(std::vector<nested_span> const& spans, std::string const& name,
                     std::string const& outer) {
  std::int64_t sum = 0;
  for (nested_span const& s : spans)
    if (s.name() == name && s.parent >= 0 &&
        spans[static_cast<std::size_t>(s.parent)].name() == outer)
      sum += s.end - s.begin;
  return sum;
}
std::int64_t time_of(std::vector<nested_span> const& spans, std::string const& name) {
  std::int64_t sum = 0;
  for (nested_span const& s : spans)
    if (s.name() == name) sum += s.end - s.begin;
  return sum;
}

TEST_CASE("a trace holds every schedule as a process whose spans nest", "[trace]") {
  std::string const backend(GENERATE(from_range(backends())));
  temporary_folder const folder;
  write_bytes(folder / "scene.gltf", gltf_fixture().text());
  std::vector<std::string> arguments{
      folder / "scene.gltf", "--width", "320", "--height",       "180",        "--spp", "2",
      "--backend",           backend,   "-o",  folder / "a.pfm", "--schedule", "all"};
  REQUIRE(run_path_tracer(arguments).exit_code == 0);
  std::string const without = read_bytes(folder / "a.pfm");
  arguments.insert(arguments.end(), {"--trace", folder / "t.json"});
  outcome const result = run_path_tracer(arguments);
  CAPTURE(backend, result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(read_bytes(folder / "a.pfm") == without);

  json const trace = json::parse(read_bytes(folder / "t.json"));
  CHECK(trace["otherData"]["left_out"].empty());
  json const& events = trace["traceEvents"];
  int process = 0;
  for (std::string_view const schedule : schedules()) {
    ++process;
    CAPTURE(schedule);
    bool named = false;
    for (json const& e : events)
      named = named || (e["name"] == "process_name" && e["pid"] == process &&
                        e["args"]["name"] == "schedule " + std::string(schedule));
    CHECK(named);
    for (int const thread : {process, 1000 + process}) {
      if (thread != process && backend != "cuda") continue;
      auto const spans = nested(events, process, thread);
      REQUIRE(!spans.empty());
      CHECK(spans[0].name() == (thread == process ? "render" : "batch 1"));
      for (char const* stage : {"generate", "accumulate"})
        CHECK(time_in(spans, stage, "batch 1") > 0);
      for (char const* stage : {"intersect", "shade", "shadow", "count rays"})
        CHECK(time_in(spans, stage, "bounce 1") > 0);
      std::int64_t const dispatch = time_in(spans, "dispatch", "shade");
      std::int64_t const group = time_in(spans, "group", "shade");
      CHECK(dispatch > 0);
      CHECK((group > 0) ==
            (schedule.find('+') != schedule.npos || (schedule == "window" && backend == "cuda")));
      CHECK(group + dispatch <= time_of(spans, "shade"));
      std::int64_t shaders = 0;
      for (std::string_view const name : effect_names())
        shaders += time_in(spans, std::string(name), "dispatch");
      shaders += time_in(spans, "miss", "dispatch");
      CHECK((shaders > 0) == (schedule.find("explicit") != schedule.npos));
      CHECK(shaders <= time_of(spans, "dispatch"));
    }
  }
}

TEST_CASE("shaders of a trace have the names and numbers of those that ran", "[trace]") {
  render_settings settings = small(1, 3);
  settings.schedule = "bucket+explicit";
  settings.most_spans = 1000;
  scene clear = room();  // through fog, nothing is seen of the sky
  clear.medium_scattering = clear.medium_absorption = vec3{0};
  render_result const r = render(clear, settings);
  std::map<std::uint32_t, std::uint64_t> ran;
  std::uint64_t total = 0;
  for (span const& s : r.timeline.spans) {
    CHECK(s.shader.has_value() == (s.name == "shader"));
    if (s.shader) ran[*s.shader] += s.requests.value();
  }
  for (auto const& [shader, requests] : ran) {
    CHECK(shader < shader_count);
    CHECK(requests > 0);
    total += requests;
  }
  std::uint64_t requests = 0;
  for (bounce const& b : r.bounces) requests += b.requests;
  CHECK(total == requests);
  CHECK(ran.size() > 5);
  json const trace = json::parse(trace_json({}, {{"bucket+explicit", r}}));
  std::set<std::string> names;
  for (json const& e : trace["traceEvents"])
    if (e.contains("args") && e["args"].contains("shader")) names.insert(e["name"]);
  CHECK(names.size() == ran.size());
  CHECK(names.count("matte") == 1);
  CHECK(names.count("miss") == 1);
}

TEST_CASE("a timeline has whole batches and says how many it leaves out", "[trace]") {
  scene s;
  s.background = vec3{1};
  render_settings settings = small(450, 2);  // three batches of at most 2^18 paths
  timeline const none = render(s, settings).timeline;
  CHECK(none.spans.empty());
  CHECK(none.batches == 0);
  settings.most_spans = 1000;
  timeline const all = render(s, settings).timeline;
  CHECK(all.batches == 3);
  CHECK(all.batches_in_it == 3);
  settings.most_spans = 2;
  run const first{"local", render(s, settings)};
  CHECK(first.result.timeline.batches == 3);
  CHECK(first.result.timeline.batches_in_it == 1);
  CHECK(first.result.timeline.spans.size() < all.spans.size());
  CHECK(first.result.timeline.spans[0].name == "render");
  std::string const words = "schedule local has the first 1 of 3 batches";
  CHECK(left_out(first).find(words) != std::string::npos);
  options o;
  o.scene = "a\xff.gltf";  // a name need not be UTF-8
  json const trace = json::parse(trace_json(o, {first}));
  CHECK(trace["otherData"]["left_out"][0] == left_out(first));
  CHECK(nested(trace["traceEvents"], 1, 1).size() == first.result.timeline.spans.size());
  CHECK(left_out({"local", {}}).empty());
}

}  // namespace
