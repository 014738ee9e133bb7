#include "base/table.hpp"

#include <algorithm>

namespace axil {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \r") - begin + 1);
}

std::vector<std::string> cellsOf(std::string_view line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find('\t', begin), line.size());
    cells.emplace_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

}  // namespace

const std::string& Table::cell(const Row& row, std::string_view column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  AXIL_ASSERT(found != columns.end(), "a table is asked for a column that it does not have");
  return row.cells[static_cast<std::size_t>(found - columns.begin())];
}

std::vector<std::string> splitList(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const std::string_view piece = trimmed(text.substr(begin, end - begin));
    if (!piece.empty()) pieces.emplace_back(piece);
    begin = end + 1;
  }
  return pieces;
}

Result<Table> readTable(std::string_view text, std::string_view name) {
  Table table;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view content = text.substr(begin, end - begin);
    begin = end + 1;
    ++line;
    if (content.starts_with('#') || trimmed(content).empty()) continue;
    std::vector<std::string> cells = cellsOf(content);
    if (table.columns.empty()) {
      table.columns = std::move(cells);
      continue;
    }
    if (cells.size() != table.columns.size())
      return fail(ErrorCode::BadInput, std::string(name) + ":" + std::to_string(line) + ": the row has " + std::to_string(cells.size()) +
                                           " cells where the table has " + std::to_string(table.columns.size()) +
                                           " columns; separate cells with one tab each");
    table.rows.push_back({line, std::move(cells)});
  }
  return table;
}

}  // namespace axil
