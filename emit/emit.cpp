#include "simeco/grammar.hpp"
