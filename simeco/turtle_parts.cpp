#include "simeco/turtle_parts.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace axil::simeco::turtle {

namespace {

constexpr std::size_t kBlock = 1 << 13;

/// What a module is worth for finding one's way.
struct Worth {
  std::int8_t bracket = 0;   ///< 1 opens, -1 closes
  std::int8_t brace = 0;
  std::uint8_t parameters = 0;
};

/// A run of modules summed up. The least sums are of its beginnings, the empty one counted.
struct Block {
  std::ptrdiff_t brackets = 0, leastBrackets = 0;
  std::ptrdiff_t braces = 0, leastBraces = 0;
  std::size_t parameters = 0;
};

class Cutter {
 public:
  explicit Cutter(const ModuleString& string) : codes_(string.codes()) {
    const std::vector<Symbol>& symbols = string.symbols();
    for (std::size_t code = 0; code < symbols.size(); ++code) {
      const std::string& letter = symbols[code].letter;
      worth_[code] = {static_cast<std::int8_t>(letter == "[" ? 1 : letter == "]" ? -1 : 0), static_cast<std::int8_t>(letter == "{" ? 1 : letter == "}" ? -1 : 0),
                      static_cast<std::uint8_t>(symbols[code].parameters)};
    }
    for (std::size_t begin = 0; begin < codes_.size(); begin += kBlock) blocks_.push_back(summed(begin, std::min(begin + kBlock, codes_.size())));
  }

  std::vector<StringPart> cut(std::size_t count) {
    std::vector<StringPart> parts(1);
    parts.front().own.end = codes_.size();
    if (!closesOnlyWhatIsOpen()) return parts;
    for (std::size_t k = 1; k < count; ++k) {
      const std::size_t place = placeFrom(std::max(codes_.size() / count * k, parts.back().own.begin + 1));
      if (place >= codes_.size()) break;
      parts.back().own.end = place;
      const std::size_t parameter = parametersBefore(place);
      parts.push_back({{place, codes_.size(), parameter}, pathTo(place, parameter)});
    }
    return parts;
  }

 private:
  [[nodiscard]] Block summed(std::size_t begin, std::size_t end) const {
    Block block;
    for (std::size_t i = begin; i < end; ++i) {
      const Worth worth = worth_[codes_[i]];
      block.brackets += worth.bracket;
      block.braces += worth.brace;
      block.parameters += worth.parameters;
      block.leastBrackets = std::min(block.leastBrackets, block.brackets);
      block.leastBraces = std::min(block.leastBraces, block.braces);
    }
    return block;
  }
  [[nodiscard]] bool closesOnlyWhatIsOpen() const {
    std::ptrdiff_t brackets = 0, braces = 0;
    for (const Block& block : blocks_) {
      if (brackets + block.leastBrackets < 0 || braces + block.leastBraces < 0) return false;
      brackets += block.brackets;
      braces += block.braces;
    }
    return true;
  }

  /// The first [ from `from` on that stands in no brace.
  [[nodiscard]] std::size_t placeFrom(std::size_t from) const {
    std::ptrdiff_t braces = 0;
    for (std::size_t b = 0; b < from / kBlock && b < blocks_.size(); ++b) braces += blocks_[b].braces;
    for (std::size_t i = from / kBlock * kBlock; i < codes_.size(); ++i) {
      const Worth worth = worth_[codes_[i]];
      if (i >= from && worth.bracket > 0 && braces == 0) return i;
      braces += worth.brace;
    }
    return codes_.size();
  }
  [[nodiscard]] std::size_t parametersBefore(std::size_t place) const {
    std::size_t count = 0;
    for (std::size_t b = 0; b < place / kBlock; ++b) count += blocks_[b].parameters;
    return count + summed(place / kBlock * kBlock, place).parameters;
  }

  /// From `place` back to the start. A branch that closes before it is passed over, whole blocks at a time.
  [[nodiscard]] std::vector<Stretch> pathTo(std::size_t place, std::size_t parameter) const {
    std::vector<Stretch> path;
    std::ptrdiff_t within = 0;  // so many branches, closed by `place`, is i inside of
    std::size_t end = place;    // of the stretch at hand
    for (std::size_t i = place; i > 0;) {
      if (within > 0 && i % kBlock == 0) {
        const Block& block = blocks_[i / kBlock - 1];
        if (block.brackets - block.leastBrackets < within) {
          within -= block.brackets;
          parameter -= block.parameters;
          i -= kBlock;
          continue;
        }
      }
      const Worth worth = worth_[codes_[--i]];
      if (within == 0 && worth.bracket < 0) {
        if (end > i + 1) path.push_back({i + 1, end, parameter});
        within = 1;
      } else if (within > 0) {
        within -= worth.bracket;
        if (within == 0) end = i;
      }
      parameter -= worth.parameters;
    }
    if (within == 0 && end > 0) path.push_back({0, end, 0});
    std::reverse(path.begin(), path.end());
    return path;
  }

  std::span<const SymbolCode> codes_;
  std::array<Worth, 256> worth_{};
  std::vector<Block> blocks_;
};

}  // namespace

std::vector<StringPart> partsOf(const ModuleString& string, std::size_t count) { return Cutter(string).cut(count); }

}  // namespace axil::simeco::turtle
