#include "quantify/types.hpp"
