// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "io/gltf_document.hpp"
#include "io/gltf_properties.hpp"
#include "io/gltf_rules.hpp"

namespace path_tracer::gltf {

void omissions::add(std::string const& what, std::string const& where) {
  auto const same = [&](kind const& k) { return k.what == what; };
  auto const k = std::find_if(kinds_.begin(), kinds_.end(), same);
  if (k == kinds_.end())
    kinds_.push_back({what, where, 1});
  else if (!where.empty())
    ++k->count;
}

std::vector<std::string> omissions::lines() const {
  std::vector<std::string> result;
  for (kind const& k : kinds_) {
    std::string line = k.what;
    if (!k.first.empty()) line += " (" + k.first;
    if (!k.first.empty() && k.count > 1) line += " and " + std::to_string(k.count - 1) + " more";
    if (!k.first.empty()) line += ")";
    result.push_back(line + " is left out");
  }
  return result;
}

std::string element(json const& root, std::string const& collection, std::size_t index) {
  std::string result = collection == "meshes" ? "mesh" : collection;
  if (result.back() == 's') result.pop_back();
  result += " " + std::to_string(index);
  auto const all = root.find(collection);
  if (all == root.end() || !all->is_array() || index >= all->size()) return result;
  json const& one = (*all)[index];
  auto const name = one.is_object() ? one.find("name") : one.end();
  if (one.is_object() && name != one.end() && name->is_string())
    result += " \"" + name->get<std::string>() + "\"";
  return result;
}

namespace {

bool ends_with(std::string const& s, std::string_view end) {
  return s.size() >= end.size() && std::string_view(s).substr(s.size() - end.size()) == end;
}

template <class Part>
rule rule_of(property<Part> const& p) {
  if (p.flag != nullptr || p.text != nullptr) return text(p.path);
  return p.color != nullptr ? numbers(p.path, 3, p.low, p.high) : number(p.path, p.low, p.high);
}

std::unordered_map<std::string, rule> expanded_rules() {
  std::unordered_map<std::string, rule> result;
  std::string base;
  for (rule const& r : rules) {
    std::string const path = r.path;
    bool const relative = !path.empty() && path[0] == '@';
    if (!relative && ends_with(path, "/*")) base = path + "/";
    result.emplace(relative ? base + path.substr(1) : path, r);
  }
  for_each_property([&](std::string const& path, auto const& p) {
    result.emplace(path, rule_of(p));
    // What holds it is an object; extras belong to the application and have no rule.
    for (auto slash = path.rfind('/'); !ends_with(path.substr(0, slash), "/*");
         slash = path.rfind('/', slash - 1))
      if (path.substr(0, slash).find("/extras") == std::string::npos)
        result.emplace(path.substr(0, slash), object(""));
  });
  return result;
}

class checker {
 public:
  explicit checker(json const& root) : root_(root), rules_(expanded_rules()) {}

  void visit(json const& value, std::string const& path) {
    auto const found = rules_.find(path);
    if (found == rules_.end()) return unknown(path);
    rule const& r = found->second;
    switch (r.type) {
      case value_type::object:
        if (!value.is_object()) fail("is not an object");
        for (auto const& [key, member] : value.items()) {
          where_.push_back(key);
          visit_member(key, member, path.empty() ? key : path + "/" + key);
          where_.pop_back();
        }
        for (requirement const& needed : required)
          if (path == needed.path && !value.contains(needed.key))
            fail("has no \"" + std::string(needed.key) + "\"");
        break;
      case value_type::array:
        if (!value.is_array()) fail("is not an array");
        for (std::size_t i = 0; i < value.size(); ++i) {
          where_.push_back(std::to_string(i));
          visit(value[i], path + "/*");
          where_.pop_back();
        }
        break;
      case value_type::numbers:
        if (!value.is_array() || value.size() != r.length)
          fail("is not an array of " + std::to_string(r.length) + " numbers");
        for (json const& v : value) check_number(v, r);
        break;
      case value_type::integer:
        if (!value.is_number_integer()) fail("is not an integer");
        [[fallthrough]];
      case value_type::number:
        check_number(value, r);
        break;
      case value_type::index:
        check_index(value, r.into);
        break;
      case value_type::boolean:
        if (!value.is_boolean()) fail("is not true or false");
        break;
      case value_type::text:
        if (!value.is_string()) fail("is not a string");
        break;
      case value_type::anything:
        break;
    }
  }

  omissions take() { return std::move(left_out_); }

 private:
  // Names mean nothing, and `extras` belong to the application: only those that have a rule count.
  void visit_member(std::string const& key, json const& member, std::string const& path) {
    if (key == "name") return;
    if (key != "extras") return visit(member, path);
    if (!member.is_object()) return;
    for (auto const& [extra, value] : member.items()) {
      where_.push_back(extra);
      if (rules_.count(path + "/" + extra) != 0) visit(value, path + "/" + extra);
      where_.pop_back();
    }
  }

  void unknown(std::string const& path) {
    auto const slash = path.rfind('/');
    std::string const parent = slash == std::string::npos ? "" : path.substr(0, slash);
    std::string const key = where_.back();
    std::string what = '"' + key + '"';
    if (ends_with(parent, "extensions")) what = "extension " + key;
    if (ends_with(parent, "attributes")) what = "attribute " + key;
    left_out_.add(what, where(2));
  }

  void check_number(json const& value, rule const& r) {
    if (!value.is_number()) fail("is not a number");
    double const v = value.get<double>();
    if (v >= r.low && v <= r.high) return;  // false for NaN
    std::ostringstream text;
    text << "holds " << v << ", which is not between " << r.low << " and " << r.high;
    fail(text.str());
  }

  void check_index(json const& value, char const* into) {
    if (!value.is_number_integer()) fail("is not an integer");
    json::json_pointer const target(into);
    std::size_t const size =
        root_.contains(target) && root_.at(target).is_array() ? root_.at(target).size() : 0;
    bool const valid = value.is_number_unsigned() && value.get<std::uint64_t>() < size;
    std::string const name = std::string(into).substr(std::string_view(into).rfind('/') + 1);
    if (!valid)
      fail("is " + value.dump() + ", but the file has " + std::to_string(size) + " " + name);
  }

  /// The element at hand, and below it the property, as `mesh 3 "lamp"` and
  /// `primitives[0].indices`.
  std::string where(std::size_t parts) const {
    if (where_.size() < 2) return parts > 2 && !where_.empty() ? where_[0] : "";
    bool const is_element = root_.at(where_[0]).is_array();
    std::string result = is_element ? element(root_, where_[0], std::stoul(where_[1])) : where_[0];
    std::string rest;
    for (std::size_t i = is_element ? 2 : 1; i < where_.size() && parts > 2; ++i) {
      bool const number = where_[i].find_first_not_of("0123456789") == std::string::npos;
      if (number)
        rest += "[" + where_[i] + "]";
      else
        rest += (rest.empty() ? "" : ".") + where_[i];
    }
    return rest.empty() ? result : result + ": " + rest;
  }

  [[noreturn]] void fail(std::string const& what) const {
    std::string const at = where(~std::size_t{0});
    throw std::runtime_error(at.empty() ? "the file " + what : at + " " + what);
  }

  json const& root_;
  std::unordered_map<std::string, rule> rules_;
  std::vector<std::string> where_;
  omissions left_out_;
};

}  // namespace

omissions check(json const& root) {
  checker c(root);
  c.visit(root, "");
  return c.take();
}

}  // namespace path_tracer::gltf
