// Rows of tables as text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/parallel.hpp"

namespace lichtmc {

// Appends fields separated by commas, and a line end.
template <class... Fields>
void append_row(std::string& table, const Fields&... fields) {
  bool first = true;
  const auto append = [&](const auto& field) {
    if (!first) table += ',';
    first = false;
    table += field;
  };
  (append(fields), ...);
  table += '\n';
}

// Writes many rows. row(i, rows) appends row i of `count` to a text. Blocks of rows are made on `threads` (≥ 1)
// threads, some at a time, and written in order.
template <class Row>
void write_rows(unsigned threads, std::size_t count, const Row& row, const Sink& sink) {
  constexpr std::size_t rows_of_block = 8192;
  std::vector<std::string> blocks(std::size_t{2} * threads);
  for (std::size_t first = 0; first < count; first += blocks.size() * rows_of_block) {
    for_each_on_threads(threads, blocks.size(), [&](std::size_t k) {
      blocks[k].clear();
      const std::size_t end = std::min(count, first + (k + 1) * rows_of_block);
      for (std::size_t i = first + k * rows_of_block; i < end; ++i) row(i, blocks[k]);
    });
    for (const std::string& block : blocks) sink(block);
  }
}

}  // namespace lichtmc
