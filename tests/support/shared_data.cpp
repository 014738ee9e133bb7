#include "support/shared_data.hpp"

namespace axil::test {

std::filesystem::path sharedPath(const std::filesystem::path& relative) { return std::filesystem::path(AXIL_SHARED_DIR) / relative; }

}  // namespace axil::test
