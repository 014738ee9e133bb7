// Text that is not about plants, written to be mistaken for it: nothing may be read from any paragraph.
#include "base/files.hpp"
#include "keywords/keywords.hpp"

#include <gtest/gtest.h>

#include <string>

namespace axil::keywords {
namespace {

TEST(NotPlants, YieldNoTraitInThreeScripts) {
  const Result<std::string> text = readFile(std::string(AXIL_TEST_DIR) + "/corpus/not_plants.txt");
  ASSERT_TRUE(text) << text.error().message;
  std::size_t paragraphs = 0;
  for (std::size_t begin = 0; begin < text->size(); ++paragraphs) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    const std::string paragraph = text->substr(begin, end - begin);
    begin = end + 1;
    const Result<Traits> traits = readTraits(paragraph);
    ASSERT_TRUE(traits) << paragraph;
    std::string found;
    for (const Trait& trait : *traits) found += " [" + trait.organ + " " + trait.property + " " + trait.value + ": " + trait.text + "]";
    EXPECT_TRUE(found.empty()) << paragraph << "\n " << found;
  }
  EXPECT_GE(paragraphs, 1000u);
}

}  // namespace
}  // namespace axil::keywords
