#pragma once
/// \file
/// Private to the room: what scanning and typesetting do to words, undone where the vocabulary shows what was meant: words broken at
/// line ends or with a stray hyphen ("lanceo-\nlate"), digits in words ("e1liptic"), letters in numbers ("l-3 cm", "1O cm"),
/// broken units ("crn"), decimal commas ("1,5 cm"). A token that was put together covers all that it was made of.

#include "keywords/tokens.hpp"

namespace axil::keywords {

void repairTokens(TokenList& list);

}  // namespace axil::keywords
