#pragma once
/// \file
/// A description's file as the grammar of a typical plant.

#include "base/result.hpp"
#include "emit/described.hpp"

#include <string>

namespace axil::app {

/// Whether a file is a description by its name: it ends in .txt.
[[nodiscard]] bool isDescription(const std::string& file);

/// Reads `file` ("-": standard input) and writes the grammar of what it describes, named after the file.
[[nodiscard]] Result<emit::DescribedPlant> describedPlantIn(const std::string& file);

}  // namespace axil::app
