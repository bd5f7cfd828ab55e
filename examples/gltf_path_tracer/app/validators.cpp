// SPDX-License-Identifier: Apache-2.0
#include "app/validators.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "effects/scene_effects.hpp"
#include "io/image.hpp"

namespace path_tracer {

std::string join(std::vector<std::string> const& names) { return CLI::detail::join(names, ", "); }

CLI::Validator one_of(std::vector<std::string> const& names) {
  auto const check = [names](std::string& value) -> std::string {
    if (std::find(names.begin(), names.end(), value) != names.end()) return {};
    return "there is no \"" + value + "\", only " + join(names);
  };
  return CLI::Validator(check, "");
}

CLI::Validator list_of(std::vector<std::string> const& names) {
  auto const check = [names](std::string& value) -> std::string {
    std::vector<std::string> const given = split(value);
    for (auto name = given.begin(); name != given.end(); ++name) {
      if (*name == "all") {
        if (given.size() == 1) continue;
        return "\"all\" is every one of them: it stands alone";
      }
      if (std::find(names.begin(), names.end(), *name) == names.end())
        return "there is no \"" + *name + "\", only " + join(names) + ", or all";
      if (std::find(given.begin(), name, *name) != name) return "\"" + *name + "\" is named twice";
    }
    return {};
  };
  return CLI::Validator(check, "");
}

CLI::Validator effect_list_text() {
  auto const check = [](std::string& value) -> std::string {
    if (value == "auto" || value == "all") return {};
    try {
      effects_named(value);
      return {};
    } catch (std::invalid_argument const& e) {
      return e.what();
    }
  };
  return CLI::Validator(check, "");
}

CLI::Validator picture_path() {
  auto const check = [](std::string& value) -> std::string {
    if (has_image_ending(value)) return {};
    auto const endings = image_endings();
    return "the name of a picture ends in " +
           join(std::vector<std::string>(endings.begin(), endings.end())) + ", \"" + value +
           "\" does not";
  };
  return CLI::Validator(check, "");
}

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
  auto const check = [low, high](std::string& value) -> std::string {
    bool const digits =
        !value.empty() && value.find_first_not_of("0123456789") == std::string::npos;
    std::string const highest = std::to_string(high);
    value.erase(0, std::min(value.find_first_not_of('0'), value.size() - digits));
    bool const fits = digits && (value.size() < highest.size() ||
                                 (value.size() == highest.size() && value <= highest));
    if (fits && std::stoull(value) >= low) return {};
    return "\"" + value + "\" is not a whole number from " + std::to_string(low) + " to " + highest;
  };
  return CLI::Validator(check, "");
}

CLI::Validator decimal_number(double low, double high) {
  auto const check = [low, high](std::string& value) -> std::string {
    char* end = nullptr;
    double const number = std::strtod(value.c_str(), &end);
    bool const plain =
        !value.empty() && value.find_first_not_of("0123456789+-.eE") == std::string::npos;
    if (plain && *end == '\0' && number >= low && number <= high) return {};
    std::ostringstream limits;
    limits << low << " to " << high;
    return "\"" + value + "\" is not a number from " + limits.str();
  };
  return CLI::Validator(check, "");
}

std::vector<std::string> split(std::string const& list) {
  std::vector<std::string> result(1);
  for (char const c : list) {
    if (c == ',')
      result.emplace_back();
    else
      result.back() += c;
  }
  return result;
}

}  // namespace path_tracer
