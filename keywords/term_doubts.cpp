// Terms that mean something else beside that organ, or speak of what the vocabulary does not have.
#include "keywords/paragraph.hpp"

namespace axil::keywords {

namespace {

// What a habit can be handed on from: 枝條多，攀緣 is the plant's.
bool isBearer(const Concept& organ) {
  return isOneOf(organ.name, {"plant", "stem", "trunk", "bark", "root", "branch", "rhizome", "pseudobulb", "tuber", "bulb", "corm", "stolon", "hair", "internode", "tendril", "node"});
}

}  // namespace

// 蛇頭披針形, "wood-shaped heads ovate": where no organ was named at all, what stands before a term in its clause may be what it is about.
bool ParagraphReader::isAboutTheUnnamed(std::size_t i) const {
  if (!namedAt_.empty() || scope_.organ != nullptr) return false;
  for (std::size_t at = i; at > 0 && tokens_[at - 1].kind != TokenKind::Sign && !isSentenceEnd(at - 1); --at) {
    const std::size_t k = at - 1;
    const bool inPhrase = (k > 0 && found_[k - 1] && found_[k - 1].end > k) || (k > 1 && found_[k - 2] && found_[k - 2].end > k) || (k > 2 && found_[k - 3] && found_[k - 3].end > k);
    if (!found_[k] && !inPhrase && !isKnown(k) && !looksAdjectival(k)) return true;
  }
  return false;
}

// "Leaves 3-5, basal": where they stand; in "basal leaves" and "basal and cauline" only which are meant.
bool ParagraphReader::isPredicateBasal(std::size_t i) const {
  const bool ofLeaf = scope_.organ != nullptr && scope_.organ->name == "leaf" && scope_.subjectInClause && scope_.which.empty();
  const bool goesOn = isAny(i + 1, {"and", "or", "to", "&", "-"}) || (i + 1 < tokens_.size() && found_[i + 1].conceptAs("organ") != nullptr);
  return ofLeaf && !goesOn && (isRightBehindOrgan(i) || isChained(i) || is(i - 1, ","));
}

// "bark ... lobed", 冠毛羽狀: a statement that cannot be about the subject of its clause is not handed on to the leaf either.
bool ParagraphReader::isOfAnotherOrgan(const Category& category, const Concept* organ, bool named) const {
  const bool ofTwig = !named && organ != nullptr && organ == scope_.organ && organ->name == "branch" && scope_.organInSentence && category.property == "shape" && tokens_[scope_.organEnd - 1].kind == TokenKind::Word;
  if (ofTwig) return true;  // "branchlets slender, angled or subulate"
  const bool habitOfAPart = !named && organ != nullptr && organ == scope_.organ && scope_.subjectInClause && category.property == "habit" && !isBearer(*organ);
  if (habitOfAPart) return true;  // 葉基生，平臥: not the plant
  if (organ != nullptr && organ->name == "vein" && isHan(scope_.organEnd) && !scope_.subjectInSegment) return false;  // 沿脈被毛，披針形: the leaf again
  if (named || organ == nullptr || organ != scope_.organ || !(scope_.subjectInClause || (organ->name == "bark" && scope_.organInSentence)) || accepts(category, organ) || category.ownOrgan) return false;
  return isOneOf(organ->name, {"bark", "root", "hair", "seta", "pappus", "vein", "awn", "thorn", "ovary", "gland", "lenticel", "style", "stigma", "stamen", "anther", "filament", "seed", "fruit", "rhizome", "pericarp", "stone", "sorus"});
}

// 簇生棕色曲柔毛: hairs stand so.
bool ParagraphReader::isAboutHairs(std::size_t end) const {
  for (std::size_t at = end; at < tokens_.size() && at < end + 8 && isHan(at); ++at)
    if (isAny(at, {"毛", "腺", "鱗", "鳞", "刺"})) return true;
  return false;
}

// A Chinese noun that the vocabulary does not have.
bool ParagraphReader::isBeforeStrangeNoun(std::size_t end) const {
  return isHan(end) && !found_[end] && !isKnown(end) && !numberAt(tokens_, end) && isHan(end + 1) && !found_[end + 1];
}

// Words that mean something else beside that organ: a solitary trunk is no inflorescence, fruits in pairs do not stand opposite,
// a base cut deeply into a heart has no lobed margin.
bool ParagraphReader::saysNothingOf(const Meaning& meaning, std::size_t i, const Concept* organ, const Concept* place) const {
  const std::string& property = meaning.category->property;
  const std::string& value = meaning.entry->name;
  const std::string_view name = organ != nullptr ? std::string_view(organ->name) : std::string_view{};
  if (property == "type" && value == "solitary")
    return isOneOf(name, {"stem", "trunk", "leaf", "thorn", "branch", "seed", "bulb", "tuber", "root", "ovule", "pseudobulb", "tendril", "carpel", "stamen", "style", "rhizome", "corm", "plant"});
  if (property == "arrangement" && value == "opposite" && isAny(i, {"in", "paired", "成"})) return isOneOf(name, {"flower", "fruit", "inflorescence", "thorn", "stamen", "seed", "bract", "plant"});
  if (property == "arrangement" && value == "rosette" && isAny(i, {"basal", "radical"}) && found_[i].end == i + 1) return !isPredicateBasal(i);
  if (property == "arrangement" && value == "whorled" && i > 0 && numberAt(tokens_, i - 1)) return isOneOf(name, {"tepal", "petal", "sepal", "stamen", "bract", "carpel", "calyx", "corolla", "perianth"});
  if (property == "life form" && i > 1 && isAny(i - 1, {"old", "young", "adult", "mature", "juvenile"}) && isAny(i - 2, {"of", "on", "in"})) return true;  // "those of old trees entire"
  if (property == "life form" && i > 0 && isAny(i - 1, {"on", "of", "other", "under", "among", "host"})) return true;  // "on branches of other trees"
  const bool hairsOrSpines = property == "margin" && isOneOf(value, {"spinose", "ciliate"});
  if (hairsOrSpines && place != nullptr && isOneOf(place->name, {"apex", "surface"}) && !scope_.commaSincePlace) return true;  // 先端具刺狀尖頭, 背面具刺
  if (property == "margin" && isHan(i) && (isAny(found_[i].end, {"間", "间"}) || (is(found_[i].end, "深") && isAny(found_[i].end + 1, {"淺", "浅"})))) return true;  // 缺刻間有小齒
  const std::size_t next0 = found_[i].end;
  if (property == "shape" && is(next0, "-") && next0 + 1 < tokens_.size() && found_[next0 + 1].as("margin") != nullptr && is(i, "rounded")) return true;  // "rounded-crenate"
  if (property == "branching" && name == "inflorescence" && isHan(i)) return isAny(i, {"單", "单"});
  if (property == "arrangement" && isHan(i) && isOneOf(value, {"fascicled", "scattered"}) && isAboutHairs(found_[i].end)) return true;
  if (property == "arrangement" && value == "spiral" && isAny(found_[i].end, {"twisted", "coiled", "contorted", "curved", "wound", "扭", "捲", "卷", "旋", "彎", "弯"})) return true;
  if (property == "arrangement" && value == "rosette" && is(i + 1, "出")) return numberAt(tokens_, found_[i].end).has_value() || isAny(found_[i].end, {"脈", "脉", "掌"});  // 基出3脈
  if (property == "arrangement" && value == "rosette" && isOneOf(name, {"inflorescence", "flower", "bud", "fruit"})) return true;
  const bool inDigits = isHan(found_[i].end - 1) && numberAt(tokens_, i) && property == "apex" && (place == nullptr || place->name != "apex");
  if (inDigits && isOneOf(name, {"stigma", "ligule", "stipule", "bract", "lip", "style", "corolla", "calyx", "leaf", "leaflet"})) return true;  // 柱頭2裂 counts its lobes
  if (property == "shape" && i > 0 && isAny(i - 1, {"成", "具", "有"}) && isBeforeStrangeNoun(found_[i].end)) return true;  // 膨大成紡錘形氣囊
  if (property == "shape" && name == "plant" && scope_.organEnd > 0 && isAny(scope_.organEnd - 1, {"冠", "crown"})) return !isOneOf(value, {"conical", "pyramidal", "globose", "cylindric", "hemispheric"});  // 樹冠卵形
  if (property == "type" && value == "solitary" && is(found_[i].end, "-")) return true;  // "single-nerved"
  if (property == "type" && meaning.category->defaultOrgan == "inflorescence" && isMannerOfAnother(i, value)) return true;
  const Concept* next = nounAt(found_[i].end);
  if (property == "arrangement" && value == "fascicled" && next != nullptr && next->name == "leaf sheath") return true;  // "fascicle sheath"
  if (property == "margin" && value == "spinose" && isHan(i) && found_[i].end == i + 2 && isAny(i + 1, {"狀", "状"}) && place == nullptr) return true;  // 小苞片刺狀
  if (property == "shape" && i > 2 && isAny(i - 1, {"成", "呈"}) && isAny(i - 2, {"狹", "狭", "窄"})) return true;  // 向下漸狹成楔形: its base
  if (property == "margin" && value == "spinose" && isOneOf(name, {"fruit", "seed", "stem", "branch", "plant", "calyx"})) return true;  // 蒴果具刺
  if (property == "margin" && value == "entire" && i > 0 && isAny(i - 1, {"falling", "shed", "dispersed", "swallowed"})) return true;
  if (property == "duration" && isOneOf(value, {"annual", "biennial"}) && isOneOf(name, {"branch", "bark"})) return true;  // 二年生小枝
  if (property == "life form" && is(i, "herbaceous") && isOneOf(name, {"leaf", "leaflet", "bract", "sepal", "tepal", "stipule", "involucre"})) return true;  // a texture
  if (property == "habit" && is(found_[i].end, "base")) return true;  // "from a creeping base"
  if (name == "vein" && isOneOf(property, {"shape", "apex", "base"})) return scope_.subjectInSegment || property != "shape" || !isHan(i);
  if (property == "shape" && isHan(i) && is(found_[i].end, "毛")) return true;  // 鱗片狀毛
  if (property == "arrangement" && isOneOf(name, {"petiole", "pedicel", "peduncle", "petiolule"})) return true;  // 花梗較其對生葉短
  if (property == "arrangement" && is(found_[i].end, "with") && name != "leaf") return true;  // "alternate with corolla lobes"
  // 樹冠傘形: no umbel.
  if (property == "type" && meaning.category->defaultOrgan == "inflorescence" && isHan(i) && isAny(found_[i].end - 1, {"形", "狀", "状"})) return isOneOf(name, {"plant", "trunk", "branch"}) && scope_.organInSentence;
  if (property == "branching" && i > 0 && is(i - 1, "每")) return true;
  if (property == "margin" && value == "lobed" && i > 0 && isAny(i - 1, {"或", "至", "到"}) && lastCount_.piece == "lobe" && lastCount_.end + 1 == i) return true;  // 3淺裂或中裂
  if (property == "margin" && (isOneOf(value, {"lobed", "sinuate"}) || (value == "incised" && isOneOf(name, {"leaf", "leaflet", "pinna"})))) return place != nullptr && isOneOf(place->name, {"base", "apex"});
  return is(found_[i].end, "like") || (is(found_[i].end, "-") && is(found_[i].end + 1, "like"));
}

}  // namespace axil::keywords
