// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/third_party.hpp"

// What the files of the loader share.
namespace path_tracer::gltf {

using nlohmann::json;

/// Features of a file that the renderer leaves out, counted by kind.
class omissions {
 public:
  void add(std::string const& what, std::string const& where);
  /// One line for each kind, in order of appearance: `attribute COLOR_0 (mesh 1 and 3 more)`.
  std::vector<std::string> lines() const;

 private:
  struct kind {
    std::string what, first;
    std::size_t count;
  };
  std::vector<kind> kinds_;
};

/// A file that has passed `check`: every number is of its type and in its range, every index in
/// `json` and in `model` refers to something, and every buffer view lies inside its buffer.
/// `model` holds geometry, cameras and encoded images; what tinygltf has no type for is read from
/// `root`.
struct document {
  json root;
  tinygltf::Model model;
  omissions left_out;
};

/// Reads, checks and parses a file. Throws std::runtime_error.
document read_document(std::string const& path);

/// Checks `root` against the table of properties that the renderer understands. Throws
/// std::runtime_error at the first value of a wrong type or out of range. Returns the properties
/// that the table does not have.
omissions check(json const& root);

/// `node 3 "lamp"`: element number `index` of the array `collection` of the file.
std::string element(json const& root, std::string const& collection, std::size_t index);

/// The value at a JSON pointer below `from`, or `otherwise` if there is none.
template <class T>
T value_at(json const& from, char const* pointer, T otherwise) {
  json::json_pointer const p(pointer);
  return from.contains(p) ? from.at(p).get<T>() : otherwise;
}

}  // namespace path_tracer::gltf
