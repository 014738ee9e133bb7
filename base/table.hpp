#pragma once
/// \file
/// Tables of data that people edit: UTF-8 text, one row a line, cells separated by one tab. The first line that counts names
/// the columns; empty lines and lines that begin with # do not count. Cells keep inner blanks and lose those at their ends.

#include "base/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace axil {

struct Table {
  struct Row {
    int line = 0;  ///< in the text, from 1; for messages
    std::vector<std::string> cells;
  };
  std::vector<std::string> columns;
  std::vector<Row> rows;

  /// The cell of `row` under `column`; the column must exist.
  [[nodiscard]] const std::string& cell(const Row& row, std::string_view column) const;
};

/// Reads a table. Fails with BadInput on a row with more or fewer cells than there are columns; `name` stands in the message.
[[nodiscard]] Result<Table> readTable(std::string_view text, std::string_view name);

/// The pieces of `text` between `separator`s, blanks at their ends removed, empty pieces left out.
[[nodiscard]] std::vector<std::string> splitList(std::string_view text, char separator);

}  // namespace axil
