// SPDX-License-Identifier: Apache-2.0
#include "app/trace.hpp"

#include <deferred_shade/version.hpp>
#include <nlohmann/json.hpp>

#include "effects/scene_effects.hpp"

namespace path_tracer {
namespace {

using json = nlohmann::ordered_json;

/// Perfetto takes the thread with the number of its process for the main one and shows it first,
/// and numbers of threads for unique over processes, as on Linux.
std::size_t host_of(std::size_t process) { return process; }
std::size_t device_of(std::size_t process) { return 1000 + process; }

/// An event of its own line. A name that is not UTF-8 is written with replacement characters.
std::string line(json const& event) {
  return event.dump(-1, ' ', false, json::error_handler_t::replace);
}

json name_of(char const* what, std::size_t process, std::size_t thread, std::string const& name) {
  return {
      {"ph", "M"}, {"name", what}, {"pid", process}, {"tid", thread}, {"args", {{"name", name}}}};
}

std::string shader_name(std::uint32_t id) {
  return id == static_cast<std::uint32_t>(miss) ? "miss" : std::string(effect_names().at(id));
}

json event_of(span const& s, std::size_t process) {
  json arguments = json::object();
  if (s.shader) arguments["shader"] = *s.shader;
  if (s.requests) arguments["requests"] = *s.requests;
  return {{"ph", "X"},
          {"name", s.shader ? shader_name(*s.shader) : s.name},
          {"pid", process},
          {"tid", s.on_device ? device_of(process) : host_of(process)},
          {"ts", static_cast<double>(s.begin) / 1e3},
          {"dur", static_cast<double>(s.end - s.begin) / 1e3},
          {"args", arguments}};
}

}  // namespace

std::string title_of(run const& r) {
  std::string const number = r.repetition > 1 ? ", repetition " + std::to_string(r.repetition) : "";
  return "schedule " + r.schedule + number;
}

std::string left_out(run const& r) {
  timeline const& t = r.result.timeline;
  if (t.batches_in_it == t.batches) return "";
  return "the trace of " + title_of(r) + " has the first " + std::to_string(t.batches_in_it) +
         " of " + std::to_string(t.batches) + " batches: it ends with the one that reaches " +
         std::to_string(most_traced_spans) + " spans";
}

std::string trace_json(options const& o, std::vector<run> const& runs) {
  std::vector<std::string> lines;
  json missing = json::array();
  bool const on_gpu = o.settings.backend == "cuda";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    std::size_t const process = k + 1;
    lines.push_back(line(name_of("process_name", process, host_of(process), title_of(runs[k]))));
    lines.push_back(line(name_of("thread_name", process, host_of(process),
                                 on_gpu ? "host: submission" : o.settings.backend + ": work")));
    if (on_gpu)
      lines.push_back(line(name_of("thread_name", process, device_of(process), "GPU: work")));
    for (span const& s : runs[k].result.timeline.spans) lines.push_back(line(event_of(s, process)));
    if (std::string const text = left_out(runs[k]); !text.empty()) missing.push_back(text);
  }
  json const about = {{"deferred_shade_version", DEFERRED_SHADE_VERSION},
                      {"scene", o.scene},
                      {"backend", o.settings.backend},
                      {"left_out", missing}};
  std::string text =
      "{\"displayTimeUnit\": \"ms\",\n\"otherData\": " + line(about) + ",\n\"traceEvents\": [\n";
  for (std::size_t k = 0; k < lines.size(); ++k)
    text += lines[k] + (k + 1 < lines.size() ? ",\n" : "\n");
  return text + "]}\n";
}

}  // namespace path_tracer
