// SPDX-License-Identifier: Apache-2.0
// Six shaders of which one has 95 of 100 requests, on a GPU: all schedules and controls, as in
// schedules.cpp.
#include <algorithm>
#include <memory>

#include "axes.hpp"
#include "schedules/rows_of.hpp"

namespace {

using six_moderate = bench::shader_set<0, 6, 0>;

void add_cells(bench::row_list const& list, std::size_t n, std::shared_ptr<bench::batch>& current) {
  for (bench::row const& row : list.rows) {
    std::string const name = "6 moderate, uneven/" + row.shaders + "/" + row.schedule;
    bench::add_cell(name + "/n:" + std::to_string(n), [=, &current, &list](auto& state) {
      if (!current || current->requests(false).n != n) {
        current = nullptr;
        current =
            std::make_shared<bench::batch>(bench::make_uneven_ids(n, list.shaders), list.shaders);
        auto const& first = list.rows[2];
        if (!bench::check(state, current->take_reference(first.shade, list.plain_loop))) return;
      }
      if (!bench::check(state, current->agrees(row.shade, row.sorted))) return;
      bench::view const requests = current->requests(row.sorted);
      bench::measure(state, n, [&] { row.shade(requests); });
    });
  }
}

}  // namespace

int main(int argc, char** argv) {
  bench::row_list const list = bench::rows_of<six_moderate>();
  std::shared_ptr<bench::batch> current;
  return bench::run(argc, argv, [&](bool quick) {
    using bench::operator""_mi;
    for (std::size_t const n : quick ? std::vector{1_mi} : std::vector{1_mi, 8_mi}) {
      add_cells(list, n, current);
    }
  });
}
