#include "skeleton3d/types.hpp"
