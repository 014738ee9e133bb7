#pragma once
/// \file
/// Private to the room: the tables of data/, read alike for leaves, flowers and fruits. A row is a shape, or a change to one: a
/// cell "-" leaves the member as it is. The tables are part of the program, so a fault in one is our own bug and stops with the reason.

#include "base/table.hpp"
#include "base/text.hpp"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axil::organs {

/// One cell of a shape table, read as what its column holds.
struct ShapeCell {
  const std::string& text;

  [[nodiscard]] double number() const { return numberOf(text); }
  [[nodiscard]] int whole() const { return static_cast<int>(number()); }
  /// Three numbers, "0.8 0.2 0.1".
  [[nodiscard]] glm::vec3 colour() const {
    const std::vector<std::string> pieces = splitList(text, ' ');
    AXIL_ASSERT(pieces.size() == 3, "a colour of a shape table is not three numbers");
    return {static_cast<float>(numberOf(pieces[0])), static_cast<float>(numberOf(pieces[1])), static_cast<float>(numberOf(pieces[2]))};
  }
  template <class T, std::size_t N>
  [[nodiscard]] T oneOf(const std::array<std::pair<std::string_view, T>, N>& words) const {
    const auto found = std::find_if(words.begin(), words.end(), [&](const auto& w) { return w.first == text; });
    AXIL_ASSERT(found != words.end(), "a shape table has a word that is none of its column's");
    return found->second;
  }

 private:
  static double numberOf(const std::string& words) {
    const std::optional<double> number = parseNumber(words);
    AXIL_ASSERT(number.has_value(), "a shape table has a cell that is no number");
    return *number;
  }
};

/// A column of a shape's tables and the member it fills.
template <class Shape>
struct ShapeColumn {
  std::string_view name;
  void (*set)(Shape&, const ShapeCell&);
};

/// A table whose first column is `name` and whose others are among `columns`.
template <class Shape>
class ShapeTable {
 public:
  ShapeTable(std::string_view text, std::string_view tableName, std::span<const ShapeColumn<Shape>> columns) {
    Result<Table> table = readTable(text, tableName);
    AXIL_ASSERT(table.has_value(), "a shape table has rows of unequal length");
    AXIL_ASSERT(!table->columns.empty() && table->columns.front() == "name", "a shape table does not begin with the column name");
    for (std::size_t c = 1; c < table->columns.size(); ++c) {
      const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& column) { return column.name == table->columns[c]; });
      AXIL_ASSERT(found != columns.end(), "a shape table has a column that its shapes do not know");
      columns_.push_back(*found);
    }
    for (Table::Row& row : table->rows) rows_.push_back(std::move(row.cells));
  }

  /// The rows' names, in the table's order.
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& row : rows_) names.push_back(row.front());
    return names;
  }
  /// `shape` with what the row of that name says; nothing when there is no such row.
  [[nodiscard]] std::optional<Shape> changed(std::string_view name, Shape shape) const {
    for (const auto& row : rows_)
      if (row.front() == name) return filled(row, std::move(shape));
    return std::nullopt;
  }
  /// The rows as shapes of their own.
  [[nodiscard]] std::vector<Shape> shapes() const {
    std::vector<Shape> shapes;
    for (const auto& row : rows_) {
      shapes.push_back(filled(row, Shape{}));
      shapes.back().name = row.front();
    }
    return shapes;
  }

 private:
  [[nodiscard]] Shape filled(const std::vector<std::string>& row, Shape shape) const {
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (row[c + 1] != "-") columns_[c].set(shape, ShapeCell{row[c + 1]});
    return shape;
  }

  std::vector<ShapeColumn<Shape>> columns_;
  std::vector<std::vector<std::string>> rows_;
};

template <class Shape>
std::optional<Shape> namedIn(const std::vector<Shape>& shapes, std::string_view name) {
  for (const Shape& shape : shapes)
    if (shape.name == name) return shape;
  return std::nullopt;
}

}  // namespace axil::organs
