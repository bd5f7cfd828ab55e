// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace path_tracer {

// What a value of the command line may be. Each refuses others in one sentence.

std::string join(std::vector<std::string> const& names);

CLI::Validator one_of(std::vector<std::string> const& names);

/// Names of a list, each once and separated by commas, or `all` alone.
CLI::Validator list_of(std::vector<std::string> const& names);

/// A list of effects, `auto` or `all`.
CLI::Validator effect_list_text();

/// A name that ends as a picture's does.
CLI::Validator picture_path();

/// A whole number; CLI11's own conversion takes what is too large for the type without a word.
CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);

/// A decimal number, as 1.5, -2 or 1e-3.
CLI::Validator decimal_number(double low, double high);

/// The parts of a text that stand between commas.
std::vector<std::string> split(std::string const& list);

}  // namespace path_tracer
