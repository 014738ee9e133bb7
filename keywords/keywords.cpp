#include "keywords/types.hpp"
