#include "simeco/plant.hpp"
