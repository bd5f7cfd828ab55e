// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/trace.hpp"
#include "effects/scene_effects.hpp"
#include "io/gltf.hpp"
#include "io/image.hpp"
#include "io/output_file.hpp"

namespace {

using namespace path_tracer;

/// One line on stderr, whatever the text holds.
void complain(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  std::cerr << "gltf_path_tracer: " << text << std::endl;
}

/// Fails before the work rather than after it.
void check_outputs(options const& o) {
  check_writable(o.output);
  if (!o.report.empty()) check_writable(o.report);
  if (!o.trace.empty()) check_writable(o.trace);
  if (o.heatmap_folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(o.heatmap_folder, error);
  if (error) throw std::runtime_error("cannot make " + o.heatmap_folder + ": " + error.message());
  check_writable((std::filesystem::path(o.heatmap_folder) / "bounce_01.png").string());
}

render_result render_with(options const& o, scene const& s, std::string const& schedule) {
  render_settings settings = o.settings;
  settings.schedule = schedule;
  settings.statistics =
      o.settings.schedule == "all" || !o.report.empty() || !o.heatmap_folder.empty();
  if (!o.trace.empty()) settings.most_spans = most_traced_spans;
  if (o.quiet) return render(s, settings);
  progress shown(schedule, stderr);
  return render(s, settings, [&](double fraction) { shown(fraction); });
}

void print_summary(options const& o, std::vector<run> const& runs) {
  for (run const& r : runs) {
    if (r.result.discarded_samples > 0)
      complain("warning: schedule " + r.schedule + " discarded " +
               std::to_string(r.result.discarded_samples) + " samples that were not finite");
    if (std::string const text = left_out(r); !text.empty()) complain("warning: " + text);
  }
  if (o.settings.schedule == "all") {
    std::cout << table(runs);
    std::cout << "all " << runs.size() << " pictures are bit-identical\n";
  }
  std::cout << o.output << ": " << o.settings.width << " x " << o.settings.height << ", "
            << o.settings.samples << " samples per pixel, " << runs.front().result.rays << " rays, "
            << duration(runs.front().result.seconds) << "\n";
}

/// The scene with the effects that the options leave it; the settings get the code for them.
scene load(options& o) {
  bool const names = o.effects != "auto" && o.effects != "all";
  scene s = load_gltf(o.scene, names ? effects_named(o.effects) : effect_bits().set());
  if (o.effects != "all") specialize(o.settings, s);
  return s;
}

void run_all(options o) {
  check_outputs(o);
  scene const s = load(o);
  if (!o.quiet)
    for (std::string const& warning : s.warnings) complain("warning: " + warning);

  if (o.explain) std::cout << explain(s, o.settings.variant) << std::flush;

  bool const all = o.settings.schedule == "all";
  std::vector<run> runs;
  for (std::string_view const name :
       all ? schedules() : std::vector<std::string_view>{o.settings.schedule}) {
    runs.push_back({std::string(name), render_with(o, s, std::string(name))});
    run& last = runs.back();
    if (!o.heatmap_folder.empty()) write_heatmaps(o.heatmap_folder, o.settings, last, all);
    for (bounce& b : last.result.bounces) b.pixel_efficiency = {};
    if (runs.size() > 1) {
      require_identical(runs.front(), last);
      last.result.pixels = {};
    }
  }
  write_image(o.output, {o.settings.width, o.settings.height, runs.front().result.pixels});
  if (!o.report.empty()) write_file(o.report, json_report(o, s.triangles.size(), runs));
  if (!o.trace.empty()) write_file(o.trace, trace_json(o, runs));
  if (!o.quiet) print_summary(o, runs);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    auto const o = parse_options(argc, argv, std::cout);
    if (o) run_all(*o);
    if (!std::cout.flush()) throw std::runtime_error("cannot write to standard output");
    return 0;
  } catch (usage_error const& e) {
    complain(std::string(e.what()) + " (--help lists the options)");
    return 2;
  } catch (std::bad_alloc const&) {
    complain("out of memory");
  } catch (std::exception const& e) {
    complain(e.what());
  }
  return 1;
}
