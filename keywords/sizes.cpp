// Sizes and angles: whose they are.
#include "keywords/paragraph.hpp"

#include <algorithm>

namespace axil::keywords {

namespace {
constexpr double tallestPlant_m = 150;  // what is said to be higher is where it grows
}

bool ParagraphReader::isAltitude(std::size_t i) const {
  bool comma = false;
  for (std::size_t back = 1; back <= 7 && back <= i; ++back) {
    if (back == 1 && is(i - back, "深")) return true;
    comma = comma || is(i - back, ",");
    if (isAny(i - back, {"elevation", "elevations", "altitude", "altitudes", "alt", "elev", "拔", "depth", "depths"})) return true;
    if (isAny(i - back, {"apart", "distance"}) && !comma) return true;
    if (isAny(i - back, {"距"}) && i > back && isAny(i - back - 1, {"間", "间", "株", "行"})) return true;
    if (isAny(i - back, {";", "。", "；"}) || nounAt(i - back) != nullptr) return false;
  }
  return false;
}

// "About 5 feet high.", 高1-2公尺，多分枝: a sentence that begins with a height is about the plant that was named, or the first to be said.
bool ParagraphReader::isHeightOfPlant(const Size& size) const {
  if (scope_.organInSentence || size.dimension != "height" || !opensSentence(size.first)) return false;
  return namedAt_.empty() || namedAt_.contains(&organNamed("plant")) || plantSeen_;
}

// "adnate to the petiole for 1-2 mm", "free from ovary 2-4 mm": how far something reaches is no size of it.
bool ParagraphReader::isExtent(std::size_t first) const {
  const bool byMeans = first > 2 && (is(first - 2, "by") || is(first - 3, "by"));  // "climbing by roots to 20 m"
  return first > 0 && (is(first - 1, "for") || (placeOnlyEnd_ == first && !isHan(first - 1) && !byMeans));
}

std::size_t ParagraphReader::readSizes(std::size_t i) {
  const std::vector<Size> sizes = sizesAt(tokens_, found_, i);
  if (sizes.empty()) return 0;
  // "4 5 cm": the sign between them was lost, so neither number can be trusted.
  if (i > 0 && tokens_[i - 1].kind == TokenKind::Number && tokens_[i].kind == TokenKind::Number) return sizes.front().end;
  const std::size_t end = sizes.front().end;
  if (isHeightOfPlant(sizes.front())) enterPlant(sizes.front().first);
  const bool ofPlace = scope_.place != nullptr && scope_.place->name != "surface" && !scope_.commaSincePlace;
  const Size& size0 = sizes.front();
  const bool tooLarge = size0.unit == "m" && ((size0.range.low == 0 && size0.range.high > 0) || size0.range.high > tallestPlant_m);  // "pond margins; 0-900 m"
  const bool elsewhere = isAltitude(i) || tooLarge || isAny(end, {"a", "above", "asl", "apart", "below", "deep", "from", "away"});
  const Concept* attributive = isSentenceEnd(end - 1) ? nullptr : organAfter(end);  // "80 cm d.b.h. Leaves"
  const bool linked = isHan(end) && isAny(end, {"的", "之"});  // 直徑3-5公釐的珠芽
  const Concept* subject = attributive != nullptr && attributive != scope_.organ && (linked || !scope_.subjectInClause) ? attributive : scope_.organ;
  const Concept* organ = measuredOrgan(sizes.front(), subject);
  if (!(scope_.organInSentence || subject == attributive) || organ == nullptr || (ofPlace && !(linked && subject == attributive)) || elsewhere || isExtent(sizes.front().first)) return end;
  if (scope_.stranger && subject != attributive) return end;
  const bool ofWhole = scope_.container == organ && !scope_.subjectInSegment && !isRightBehindOrgan(sizes.front().first);
  const Concept* piece = organ == scope_.organ && !ofWhole ? scope_.piece : nullptr;
  const std::string& bare = piece != nullptr ? piece->columns.at("size") : organ->columns.at("size");
  const bool goesOn = sizeEnd_ != 0 && sizes.front().first == sizeEnd_ + 1 && is(sizeEnd_, "and");  // "up to 20 cm long and 3 mm wide"
  for (Size size : sizes) {
    if (goesOn && size.qualifier.empty()) size.qualifier = sizeQualifier_ == "up to" ? sizeQualifier_ : std::string();
    // 胸徑 names the trunk and the diameter in one word; the organ's own word can say what a bare number measures.
    const Concept* ownWord = scope_.organEnd > 0 && isRightBehindOrgan(size.first) && size.dimension.empty() ? dimensionOfOrganWord() : nullptr;
    const std::string property = !size.dimension.empty() ? size.dimension : ownWord != nullptr ? ownWord->name : bare;
    // A bare size belongs to a whole plant only right behind its name: "Shrub 2-3 m", "Trees deciduous, to 25 m".
    const bool isFar = i > scope_.organEnd + 14;
    if (size.dimension.empty() && property == "height" && isFar) continue;
    evidence_ += (size.dimension.empty() ? 0 : 0.5) + (isRightBehindOrgan(size.first) ? 1 : 0);
    if (organ->name == "plant" && property == "height" && isRightBehindOrgan(size.first)) {  // "tree up to 8 m high"
      evidence_ += 1;
      bodySeen_ = true;
    }
    Trait trait = traitAt(size.first, size.end, organ->name, property);
    const bool onlyUpTo = size.qualifier == "up to" && size.range.low == size.range.high && !size.range.minimum;
    if (!onlyUpTo) trait.low = size.range.low;
    trait.high = size.range.high;
    trait.minimum = size.range.minimum;
    trait.maximum = size.range.maximum;
    trait.unit = size.unit;
    trait.qualifier = size.qualifier;
    if (piece != nullptr) trait.part = piece->name;
    trait.which = scope_.which;
    keep(std::move(trait), organ != scope_.organ);
  }
  sizeEnd_ = end;
  sizeQualifier_ = result_.traits.empty() ? std::string() : result_.traits.back().qualifier;
  return end;
}

// Mostly the organ in scope. 連葉柄長5公分 of leaflets measures the leaf; the height beside a trunk is the tree's; behind a comma
// the length is that of the raceme whose flowers were counted, the diameter that of the flowers that make up the head.
const Concept* ParagraphReader::measuredOrgan(const Size& size, const Concept* subject) const {
  if (subject == nullptr) return nullptr;
  if (subject->name == "leaflet" && isAny(size.first, {"連", "连"})) return &organNamed("leaf");
  const bool beside = !isRightBehindOrgan(size.first);
  const bool below = isOneOf(subject->name, {"rhizome", "root", "tuber", "bulb", "corm", "stolon"});  // 具匍匐根莖，高40-80公分
  if ((subject->name == "branch" || below) && size.dimension == "height" && beside) return &organNamed(namedAt_.contains(&organNamed("stem")) ? "stem" : "plant");
  if (isOneOf(subject->name, {"trunk", "bark"}) && size.dimension == "height" && plantInSentence_ && beside) return &organNamed("plant");
  const bool afterComma = beside && !scope_.subjectInSegment;
  // 側脈5對，長8公分，寬4公分: the blade is measured; 果具軟刺，徑1公分: the fruit.
  if (subject->name == "vein" && afterComma && (size.dimension == "length" || size.dimension == "width")) return bladeNamedLast();
  if (subject->name == "thorn" && afterComma && scope_.host != nullptr) return scope_.host;
  const bool ofPiece = scope_.container == subject;
  if (scope_.container != nullptr && !ofPiece && afterComma && (size.dimension.empty() || size.dimension == "length")) return scope_.container;
  if (scope_.member != nullptr && afterComma && size.dimension == "diameter") return scope_.member;
  return subject;
}

// The leaf, or in a sentence that has named leaflets those.
const Concept* ParagraphReader::bladeNamedLast() const {
  const Concept& leaflet = organNamed("leaflet");
  const auto named = subjectAt_.find(&leaflet);
  return named != subjectAt_.end() && named->second >= sentenceBegin_ ? &leaflet : &organNamed("leaf");
}

const Concept* ParagraphReader::dimensionOfOrganWord() const {
  for (std::size_t at = scope_.organEnd; at-- > 0 && at + 6 > scope_.organEnd;)
    if (found_[at] && found_[at].end == scope_.organEnd && found_[at].as("organ") != nullptr) return found_[at].conceptAs("dimension");
  return nullptr;
}

// "at 45 degrees", "30-45°", 夾角40～50度.
std::size_t ParagraphReader::readAngle(std::size_t i) {
  const std::optional<NumberRange> range = rangeAt(tokens_, i);
  if (!range || range->high > 360) return 0;
  const std::size_t sign = range->end;
  // 1° behind the first number too: "30°-45°".
  if (!isAny(sign, {"°", "degrees", "degree", "度"}) || isAny(sign + 1, {"c", "f", "n", "s", "e", "w"})) return 0;
  const std::size_t end = is(sign, "度") && is(sign + 1, "角") ? sign + 2 : sign + 1;
  if (scope_.organ == nullptr || !scope_.organInSentence) return end;
  bool isDivergence = false;
  for (std::size_t back = 1; back <= 6 && back <= i; ++back) isDivergence = isDivergence || isAny(i - back, {"divergence", "divergent"}) || (is(i - back, "散") && i > back && is(i - back - 1, "開"));
  Trait trait = traitAt(i, end, scope_.organ->name, isDivergence ? "divergence" : "angle");
  trait.low = range->low;
  trait.high = range->high;
  trait.minimum = range->minimum;
  trait.maximum = range->maximum;
  trait.unit = "°";
  trait.which = scope_.which;
  evidence_ += 1.5;
  keep(std::move(trait), false);
  return end;
}

}  // namespace axil::keywords
