#pragma once
/// \file
/// Private to the room: the tables of data/ as shapes. They are part of the program, so a fault in one is our own bug and
/// stops with the reason.

#include "base/table.hpp"
#include "base/text.hpp"

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace axil::organs {

struct ShapeRow {
  const Table& table;
  const Table::Row& row;

  [[nodiscard]] const std::string& text(std::string_view column) const { return table.cell(row, column); }
  [[nodiscard]] double number(std::string_view column) const {
    const std::optional<double> number = parseNumber(text(column));
    AXIL_ASSERT(number.has_value(), "a shape table has a cell that is no number");
    return *number;
  }
  [[nodiscard]] int whole(std::string_view column) const { return static_cast<int>(number(column)); }
  /// Three numbers, "0.8 0.2 0.1".
  [[nodiscard]] glm::vec3 colour(std::string_view column) const {
    glm::vec3 colour{0, 0, 0};
    const std::vector<std::string> pieces = splitList(text(column), ' ');
    AXIL_ASSERT(pieces.size() == 3, "a colour of a shape table is not three numbers");
    for (int i = 0; i < 3; ++i) {
      const std::optional<double> number = parseNumber(pieces[static_cast<std::size_t>(i)]);
      AXIL_ASSERT(number.has_value(), "a colour of a shape table is not three numbers");
      colour[i] = static_cast<float>(*number);
    }
    return colour;
  }
};

template <class Shape>
std::vector<Shape> readShapeTable(std::string_view text, std::string_view name, Shape (*shapeOf)(const Table&, const Table::Row&)) {
  const Result<Table> table = readTable(text, name);
  AXIL_ASSERT(table.has_value(), "a shape table has rows of unequal length");
  std::vector<Shape> shapes;
  for (const Table::Row& row : table->rows) shapes.push_back(shapeOf(*table, row));
  return shapes;
}

template <class Shape>
std::optional<Shape> namedIn(const std::vector<Shape>& shapes, std::string_view name) {
  for (const Shape& shape : shapes)
    if (shape.name == name) return shape;
  return std::nullopt;
}

}  // namespace axil::organs
