#include "keywords/words.hpp"

namespace axil::keywords {

bool negates(std::string_view word) {
  return isOneOf(word, {"not", "never", "non", "neither", "nor", "without", "lacking", "不", "非", "無", "无", "未", "沒", "没", "缺", "no"});
}

std::string_view qualifierOf(std::string_view word) {
  if (isOneOf(word, {"rarely", "seldom", "稀", "罕", "偶", "occasionally", "exceptionally", "infrequently", "稀為"})) return "rarely";
  if (isOneOf(word, {"sometimes", "有時", "時", "时"})) return "sometimes";
  if (isOneOf(word, {"usually", "mostly", "often", "generally", "commonly", "typically", "mainly", "frequently", "normally", "多", "常", "predominantly"})) return "usually";
  if (isOneOf(word, {"narrowly", "narrow", "狹", "狭", "窄"})) return "narrowly";
  if (isOneOf(word, {"broadly", "broad", "widely", "闊", "阔", "寬", "宽", "廣", "广"})) return "broadly";
  if (isOneOf(word, {"nearly", "almost", "sub", "近", "略", "稍", "微", "亞", "亚", "slightly", "somewhat", "weakly", "obscurely", "幾", "几"})) return "nearly";
  if (isOneOf(word, {"shortly", "abruptly", "gradually", "sharply", "coarsely", "finely", "minutely", "remotely", "shallowly", "deeply", "densely", "sparsely", "distinctly",
                     "irregularly", "long", "short", "closely", "loosely", "conspicuously", "evenly", "unevenly", "strongly", "thinly", "thickly", "softly", "entirely", "very",
                     "密", "疏", "短", "長", "长", "粗", "細", "细", "淺", "浅", "深", "薄", "厚"}))
    return word.front() >= 'a' && word.front() <= 'z' ? word : std::string_view{};
  return {};
}

bool leadsElsewhere(std::string_view next) {
  return isOneOf(next, {"the", "a", "an", "of", "this", "that", "these", "his", "her", "their", "its", "my", "our", "your", "each", "one", "number"});
}

bool isFiller(std::string_view word) {
  return isOneOf(word, {"the", "a", "an", "of", "and", "or", "to", "in", "on", "at", "with", "by", "from", "is", "are", "be", "as", "its", "their", "it", "for", "into", "has", "have",
                        "ca", "about", "up", "per", "each", "when", "than", "but", "this", "that", "which", "both", "ca.", "c", "towards", "toward", "near", "along", "between", "x",
                        "species", "most", "always", "becoming", "age", "numerous", "many", "few", "several", "borne", "bearing", "having", "together", "only", "more", "less", "ones", "side", "sides", "pairs", "pair", "flowering", "fruiting", "anthesis", "maturity", "dry", "drying", "fresh",
                        "的", "之", "與", "与", "和", "及", "或", "至", "到", "為", "为", "呈", "有", "具", "被", "約", "约", "可", "達", "达", "於", "于", "在", "是", "枚", "片", "個", "个",
                        "朵", "對", "对", "條", "条", "生", "上", "下", "中", "常", "稀", "數", "数", "成", "形", "狀", "状", "色", "本", "種", "种", "植", "物", "時", "时", "熟", "各", "每", "一",
                        "節", "节", "處", "处", "裂", "緣", "缘", "邊", "边", "端", "部", "面", "無", "无", "不", "近", "略", "稍", "密", "疏", "長", "长", "短", "狹", "狭", "闊", "寬", "宽"});
}

}  // namespace axil::keywords
