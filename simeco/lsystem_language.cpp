#include "simeco/lsystem_language.hpp"

#include "base/files.hpp"
#include "base/text.hpp"

namespace axil::simeco {

IncludeReader includesBeside(const std::filesystem::path& file) {
  return [folder = file.parent_path()](const std::string& name) -> Result<std::string> {
    const std::filesystem::path asked(name);
    const std::filesystem::path tidy = asked.lexically_normal();
    if (asked.is_absolute() || tidy.empty() || *tidy.begin() == "..")
      return fail(ErrorCode::BadInput, "cannot include " + name + ": an included file must lie in the folder of the grammar; copy it there");
    Result<std::string> bytes = readFile(folder / tidy);
    if (!bytes && bytes.error().code == ErrorCode::NotFound)
      return fail(ErrorCode::NotFound, "cannot include " + name + ": there is no such file beside the grammar");
    if (!bytes) return bytes;
    std::optional<DecodedText> text = decodeText(*bytes);
    if (!text) return fail(ErrorCode::Unreadable, "cannot include " + name + ": it is not a text");
    return std::move(text->utf8);
  };
}

}  // namespace axil::simeco
