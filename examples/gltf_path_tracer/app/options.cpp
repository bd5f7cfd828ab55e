// SPDX-License-Identifier: Apache-2.0
#include "app/options.hpp"

#include <algorithm>
#include <deferred_shade/version.hpp>
#include <sstream>

#include "app/validators.hpp"
#include "effects/scene_effects.hpp"
#include "io/image.hpp"

namespace path_tracer {
namespace {

constexpr std::uint32_t largest_side = 16384, most_samples = 1u << 20, deepest = 1024;
constexpr std::uint32_t most_repetitions = 1000;
constexpr double most_stops = 20;
constexpr std::size_t help_column = 24;
constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26;

template <class Names>
std::vector<std::string> strings(Names const& names) {
  return {names.begin(), names.end()};
}

/// The preferred name if this build has it, else its first.
std::string default_name(std::vector<std::string_view> const& names, std::string const& preferred) {
  bool const has = std::find(names.begin(), names.end(), preferred) != names.end();
  return has || names.empty() ? preferred : std::string(names.front());
}

std::string version() {
  return "gltf_path_tracer (deferred_shade) " + std::to_string(DEFERRED_SHADE_VERSION_MAJOR) + "." +
         std::to_string(DEFERRED_SHADE_VERSION_MINOR) + "." +
         std::to_string(DEFERRED_SHADE_VERSION_PATCH);
}

/// Breaks lines of more than 80 characters at spaces; what follows is indented.
std::string folded(std::string const& text, std::size_t indent) {
  constexpr std::size_t most = 80;
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    while (line.size() > most) {
      std::size_t const at = line.rfind(' ', most);
      if (at == std::string::npos || at <= indent) break;  // a word that is longer
      result += line.substr(0, at) + "\n";
      line = std::string(indent, ' ') + line.substr(at + 1);
    }
    result += line + "\n";
  }
  return result;
}

/// The help text without the empty lines that CLI11 puts before each group but the first.
std::string help(CLI::App const& app) {
  std::string text = app.help();
  for (auto at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n"))
    text.erase(at, 1);
  return folded(text, help_column);
}

void declare(CLI::App& app, options& o) {
  render_settings& s = o.settings;
  std::vector<std::string> const backend_names = strings(backends());
  std::vector<std::string> const schedule_names = strings(schedules());
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  auto const text = [&](char const* name, std::string& value, std::string const& help) {
    std::string const otherwise = value.empty() ? "" : " [" + value + "]";
    return app.add_option(name, value, help + otherwise);
  };
  auto const picture = [&](char const* name, std::string& value, std::string const& help) {
    text(name, value, help)->check(picture_path())->type_name("FILE");
  };
  auto const number = [&](char const* name, auto& value, std::uint64_t low, std::uint64_t high,
                          std::string const& help) {
    return app.add_option(name, value, help + " [" + std::to_string(value) + "]")
        ->transform(whole_number(low, high))
        ->type_name("N");
  };

  auto const choice = [&](char const* name, auto& value, auto const& list,
                          std::string const& help) {
    std::vector<std::string> const names(std::begin(list), std::end(list));
    using type = std::decay_t<decltype(value)>;
    auto const take = [&value, names](std::string const& given) {
      auto const found = std::find(names.begin(), names.end(), given);
      value = static_cast<type>(found - names.begin());
    };
    app.add_option_function<std::string>(
           name, take,
           help + ": " + join(names) + " [" + names[static_cast<std::size_t>(value)] + "]")
        ->check(one_of(names))
        ->type_name("NAME");
  };

  text("scene", o.scene, "glTF 2.0 scene, .gltf or .glb")->required()->type_name("FILE");

  app.option_defaults()->group("Picture");
  picture("-o,--output", o.output, "Picture to write: " + join(strings(image_endings())));
  number("--width", s.width, 1, largest_side, "Pixels across");
  number("--height", s.height, 1, largest_side, "Pixels down");
  number("--spp", s.samples, 1, most_samples, "Samples per pixel");
  number("--max-depth", s.max_depth, 1, deepest, "Surface hits of a path at most");
  number("--seed", s.seed, 0, UINT64_MAX, "Seed of the random numbers");
  app.add_option("--exposure", o.exposure,
                 "Brightness of a PNG in stops: 1 doubles it. Other formats keep "
                 "the radiance as it is [0]")
      ->check(decimal_number(-most_stops, most_stops))
      ->type_name("STOPS");

  app.option_defaults()->group("Accuracy");
  accuracy_settings& a = s.accuracy;
  choice("--estimator", a.light, estimator_names,
         "How light is found: by sampling both lights and BSDFs, or one of them");
  number("--roulette", a.roulette_from, 1, deepest,
         "Surface hit from which on paths may end at random");
  choice("--sums", a.sums, summation_names, "How samples are added up");
  number("--octaves", a.octaves, 1, 16, "Octaves of procedural textures at most");

  app.option_defaults()->group("Execution");
  text("--backend", s.backend, "Where to run: " + join(backend_names))
      ->check(one_of(backend_names))
      ->type_name("NAME");
  number("--threads", s.threads, 0, 1024, "Threads of the CPU; 0: as many as it has");
  auto const take_schedules = [&o, schedule_names](std::string const& given) {
    o.schedules = given == "all" ? schedule_names : split(given);
  };
  app.add_option_function<std::string>(
         "--schedule", take_schedules,
         "Order of shading: " + join(schedule_names) +
             ". Several, separated by commas, or all: render with each, "
             "compare the pictures, print a table [" +
             o.schedules.front() + "]")
      ->check(list_of(schedule_names))
      ->type_name("LIST");

  app.option_defaults()->group("Effects");
  text("--effects", o.effects,
       "What to simulate. auto: what the scene calls for; all: the same, "
       "by code for all effects; or those of a list: " +
           join_names(effect_bits().set()))
      ->check(effect_list_text())
      ->type_name("LIST");
  app.add_flag("--explain", o.explain,
               "Print what calls for which effect and which code is chosen; render nothing");

  app.option_defaults()->group("Measurement");
  number("--repeat", o.repeat, 1, most_repetitions,
         "Render so many times with each schedule; the table has medians and spreads");
  text("--report", o.report, "Write settings and measurements as JSON")->type_name("FILE");
  picture("--heatmap-sheet", o.heatmap_sheet,
          "Write one picture with a heat map for each schedule and bounce: "
          "how many lanes work in each group of 32 requests");
  picture("--shader-ids", o.shader_ids,
          "Write a picture of the shader that each pixel runs first, with the names");
  text("--trace", o.trace,
       "Write what was done and when, for https://ui.perfetto.dev or "
       "chrome://tracing: trace events as JSON")
      ->type_name("FILE");

  app.add_flag("-q,--quiet", o.quiet, "Print errors and the table only")->group("Information");
  app.set_help_flag("-h,--help", "Print this and exit")->group("Information");
  app.set_version_flag("--version", version(), "Print the version and exit")->group("Information");
}

}  // namespace

std::optional<options> parse_options(int argc, char const* const* argv, std::ostream& out) {
  options o;
  o.settings.backend = default_name(backends(), o.settings.backend);
  o.schedules = {default_name(schedules(), o.settings.schedule)};
  CLI::App app("Renders a glTF scene by wavefront path tracing, shading through deferred_shade.",
               "gltf_path_tracer");
  app.get_formatter()->column_width(help_column);
  app.footer(
      "Example:\n"
      "  gltf_path_tracer gallery.gltf -o gallery.png --spp 64 --schedule all\n\n"
      "Exit code: 0 success, 1 the scene or a file is at fault, 2 the command line is\n"
      "wrong.");
  declare(app, o);
  try {
    app.parse(argc, argv);
  } catch (CLI::CallForHelp const&) {
    out << help(app);
    return std::nullopt;
  } catch (CLI::CallForVersion const&) {
    out << version() << "\n";
    return std::nullopt;
  } catch (CLI::ParseError const& e) {
    throw usage_error(e.what());
  }
  if (std::uint64_t{o.settings.width} * o.settings.height > most_pixels)
    throw usage_error("--width times --height: the picture has more than " +
                      std::to_string(most_pixels) + " pixels");
  for (auto const& [a, b] :
       {std::pair{&o.output, &o.heatmap_sheet}, std::pair{&o.output, &o.shader_ids},
        std::pair{&o.heatmap_sheet, &o.shader_ids}})
    if (!a->empty() && *a == *b) throw usage_error("two pictures have the name " + *a);
  if (o.scene.empty()) throw usage_error("scene: the name of the file is empty");
  return o;
}

}  // namespace path_tracer
