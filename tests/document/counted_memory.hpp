#pragma once
/// \file
/// Bytes that this program holds on the heap, counted at every new and delete (what the allocator hands out, rounding included).

#include <cstddef>

namespace axil::test {

[[nodiscard]] std::size_t bytesHeld();

}  // namespace axil::test
