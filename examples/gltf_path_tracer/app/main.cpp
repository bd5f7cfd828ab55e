// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "app/heatmap.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/shader_ids.hpp"
#include "app/table.hpp"
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
  for (std::string const& path : {o.output, o.report, o.heatmap_sheet, o.shader_ids, o.trace})
    if (!path.empty()) check_writable(path);
}

render_result render_once(options const& o, scene const& s, render_settings const& settings,
                          std::string const& label) {
  if (o.quiet) return render(s, settings);
  progress shown(label, stderr);
  return render(s, settings, [&](double fraction) { shown(fraction); });
}

render_result render_with(options const& o, scene const& s, std::string const& schedule) {
  render_settings settings = o.settings;
  settings.schedule = schedule;
  settings.statistics =
      o.compares() || !o.report.empty() || !o.heatmap_sheet.empty() || !o.shader_ids.empty();
  if (!o.trace.empty()) settings.most_spans = most_traced_spans;
  return render_once(o, s, settings, schedule);
}

/// Renders a batch and drops it: no clock counts what comes first alone, such as the start of
/// threads, pages of memory that are new, or the way of the kernels to a GPU.
void warm_up(options const& o, scene const& s) {
  if (!o.compares() && o.report.empty()) return;
  render_settings settings = o.settings;
  settings.schedule = o.schedules.front();
  settings.statistics = true;
  std::uint64_t const pixels = std::uint64_t{settings.width} * settings.height;
  settings.samples = static_cast<std::uint32_t>((batch_size_of(settings) + pixels - 1) / pixels);
  render_once(o, s, settings, "warm-up");
}

/// All renderings, round by round: what slows a machine for a while then slows every schedule. The
/// first has the picture; the others had the same.
std::vector<run> render_all(options const& o, scene const& s, heatmap_sheet& sheet) {
  warm_up(o, s);
  std::vector<run> runs;
  for (std::size_t k = 1; k <= o.repeat; ++k)
    for (std::string const& name : o.schedules) {
      runs.push_back({name, render_with(o, s, name), k});
      run& last = runs.back();
      if (!o.heatmap_sheet.empty() && k == 1) sheet.add(last);
      for (bounce& b : last.result.bounces) b.pixel_efficiency = {};
      if (runs.size() == 1) continue;
      require_identical(runs.front(), last);
      last.result.pixels = {};
      last.result.first_shaders = {};
    }
  return runs;
}

void print_warnings(std::vector<run> const& runs) {
  for (run const& r : runs) {
    if (r.result.discarded_samples > 0)
      complain("warning: schedule " + r.schedule + " discarded " +
               std::to_string(r.result.discarded_samples) + " samples that were not finite");
    if (std::string const text = left_out(r); !text.empty()) complain("warning: " + text);
  }
}

void print_summary(options const& o, std::vector<run> const& runs) {
  if (!o.quiet) print_warnings(runs);
  if (o.compares())
    std::cout << table(runs) << in_short(runs) << "All " << runs.size()
              << " pictures are bit-identical.\n";
  if (o.quiet) return;
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
  if (!o.explain) check_outputs(o);
  scene const s = load(o);
  if (!o.quiet)
    for (std::string const& warning : s.warnings) complain("warning: " + warning);
  if (o.explain) {
    std::cout << explain(s, o.settings.variant) << "This was --explain: nothing is rendered.\n";
    return;
  }

  heatmap_sheet sheet(o.settings);
  std::vector<run> const runs = render_all(o, s, sheet);
  write_image(o.output, {o.settings.width, o.settings.height, runs.front().result.pixels},
              o.exposure);
  if (!o.heatmap_sheet.empty()) write_image(o.heatmap_sheet, sheet.draw());
  if (!o.shader_ids.empty())
    write_image(o.shader_ids, shader_id_picture(o.settings.width, o.settings.height,
                                                runs.front().result.first_shaders));
  if (!o.report.empty()) write_file(o.report, json_report(o, s.triangles.size(), runs));
  if (!o.trace.empty()) write_file(o.trace, trace_json(o, runs));
  print_summary(o, runs);
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
