#include "base/result.hpp"

#include <cstdio>
#include <cstdlib>

namespace axil {

void assertionFailed(const char* condition, const char* why, const char* file, int line) {
  std::fprintf(stderr, "axil: a bug in the program: %s (%s) at %s:%d. Please report it with the input.\n", why, condition, file, line);
  std::abort();
}

}  // namespace axil
