#pragma once
/// \file
/// The facts a project goes by: what its description says, and what the user decided about it (ProjectTrait).

#include "base/result.hpp"
#include "document/project.hpp"
#include "keywords/types.hpp"

namespace axil::document {

/// `said` without what was rejected, with the user's value where one was given, and with the user's own facts instead of all that is said
/// of their property. An accepted or changed fact is no longer doubtful: its qualifier is gone. A fact of the user's own has no words.
[[nodiscard]] keywords::Traits decided(const keywords::Traits& said, const SharedList<ProjectTrait>& decisions);

/// Fails as keywords::readTraits does. A project without a description has the user's own facts only.
[[nodiscard]] Result<keywords::Traits> traitsOf(const Project& project);

}  // namespace axil::document
