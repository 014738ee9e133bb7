#pragma once
/// \file
/// The files that a classic L-system may read: those beside the grammar, no others, and none is ever written. A grammar comes from
/// anybody; deriving it must not change the disk nor look around on it.

#include "base/result.hpp"

#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace axil::simeco {

enum class FileCall { Open, Close, Scan };

/// What answers fopen, fclose and fscanf. `text` holds the texts of the call, a line each: of Open the name and the mode, of Scan
/// the format. `values` are the numbers of the call, first the file's; Scan fills in what it reads behind it. Gives the call's value.
using FileHost = std::function<Result<double>(FileCall call, std::string_view text, std::span<double> values)>;

/// Reads files of the grammar's folder. Open gives a number above 0, and 0 for a file that is not there or outside the folder; a
/// file that is opened to be written is a number too, and what is printed into it is dropped. Scan understands %f %g %e %lf %d %i,
/// blanks and plain words, and gives how many numbers were read, -1 at the end of the file. At most 16 MB a file, 64 files at once.
[[nodiscard]] FileHost filesBeside(const std::filesystem::path& grammar);

}  // namespace axil::simeco
