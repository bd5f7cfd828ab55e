// SPDX-License-Identifier: Apache-2.0
// Six shaders, moderate or procedural, of which one has 95 of 100 requests, on a GPU: all schedules
// and controls, as in schedules.cpp.
#include <algorithm>
#include <memory>

#include "axes.hpp"
#include "schedules/rows_of.hpp"

namespace {

struct named_list {
  std::string name;
  bench::row_list list;
};

void add_cells(named_list const& set, std::size_t n, std::string& current_name,
               std::shared_ptr<bench::batch>& current) {
  bench::row_list const& list = set.list;
  for (bench::row const& row : list.rows) {
    std::string const name = set.name + ", uneven/" + row.shaders + "/" + row.schedule;
    std::string const batch_name = set.name + std::to_string(n);
    bench::add_cell(
        name + "/n:" + std::to_string(n), [=, &current, &current_name, &list](auto& state) {
          if (current_name != batch_name) {
            current_name.clear();
            current = nullptr;
            current = std::make_shared<bench::batch>(bench::make_uneven_ids(n, list.shaders),
                                                     list.shaders);
            auto const& first = list.rows[2];
            if (!bench::check(state, current->take_reference(first.shade, list.plain_loop))) return;
            current_name = batch_name;
          }
          if (!bench::check(state, current->agrees(row.shade, row.sorted))) return;
          bench::view const requests = current->requests(row.sorted);
          bench::measure(state, n, [&] { row.shade(requests); });
        });
  }
}

}  // namespace

int main(int argc, char** argv) {
  named_list const sets[] = {{"6 moderate", bench::rows_of<bench::shader_set<0, 6, 0>>()},
                             {"6 procedural", bench::rows_of<bench::shader_set<0, 0, 6>>()}};
  std::string current_name;
  std::shared_ptr<bench::batch> current;
  return bench::run(argc, argv, [&](bool quick) {
    using bench::operator""_mi;
    for (std::size_t const n : quick ? std::vector{1_mi} : std::vector{1_mi, 8_mi}) {
      for (named_list const& set : sets) add_cells(set, n, current_name, current);
    }
  });
}
