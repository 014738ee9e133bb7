#include "organs/types.hpp"
